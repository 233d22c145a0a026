"""What every planner may ask of a problem's free space."""

from __future__ import annotations

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from llm3.errors import PluginError
from llm3.interfaces import FreeSpace
from llm3.types import Contact, Failure, FailureKind, Goal, Mask, MotionProblem, Vector

values = st.floats(0.0, 1.0)
points = st.tuples(values, values).map(np.array)
Points = list[tuple[float, float]]


def everywhere(samples: Vector) -> Mask:
    return np.ones(len(samples), dtype=bool)


def problem(valid=everywhere, goals: Points = [(1.0, 1.0)], resolution: float = 0.05, **others) -> MotionProblem:  # noqa: B006  # only read
    limits = {"low": np.zeros(2), "high": np.ones(2)}
    return MotionProblem(
        np.zeros(2), tuple(map(Goal, goals)), valid=valid, resolution=resolution, **{**limits, **others}
    )


# ---- straight lines ------------------------------------------------------------------------------------------------


@given(points, points, st.floats(0.005, 0.5))
def test_neighbouring_samples_of_a_line_are_within_the_resolution(start, end, resolution) -> None:
    asked: list[Vector] = []

    def valid(samples: Vector) -> Mask:
        asked.append(samples)
        return everywhere(samples)

    space = FreeSpace(problem(valid, resolution=resolution))
    assert space.path(np.array([start, end]))
    samples = np.vstack(asked)
    assert space.checks == len(samples)
    along = samples[np.argsort(samples @ (end - start))]
    assert all((samples == waypoint).all(axis=1).any() for waypoint in (start, end))
    assert np.abs(np.diff(along, axis=0)).sum(axis=1).max() <= resolution * (1 + 1e-6) + 1e-9


@given(st.lists(points, min_size=1, max_size=4).map(np.array), points, st.floats(0.01, 0.5))
def test_a_path_is_free_where_all_its_lines_are(waypoints, centre, radius) -> None:
    space = FreeSpace(problem(lambda samples: np.linalg.norm(samples - centre, axis=1) > radius))
    lines = [space.path(waypoints[i : i + 2]) for i in range(max(1, len(waypoints) - 1))]
    assert space.path(waypoints) == all(lines)


@given(points, points, points, st.floats(0.01, 0.5), st.integers(0, 9))
def test_samples_that_are_certainly_free_need_no_test(start, end, centre, radius, seed) -> None:
    rng = np.random.default_rng(seed)

    def valid(samples: Vector) -> Mask:
        return np.linalg.norm(samples - centre, axis=1) > radius

    def uncertain(start: Vector, end: Vector, steps: int) -> Mask:
        line = start + np.linspace(0.0, 1.0, steps + 1)[:, None] * (end - start)
        return (np.linalg.norm(line - centre, axis=1) < radius + 1e-9) | (rng.random(steps + 1) < 0.5)

    ends = np.array([start, end])
    every, some = (FreeSpace(problem(valid, resolution=0.01, uncertain=u)) for u in (None, uncertain))
    assert some.path(ends) == every.path(ends)
    assert some.checks <= every.checks


@given(points, points, st.floats(0.005, 0.5))
def test_a_line_has_the_same_samples_in_both_directions(start, end, resolution) -> None:
    asked: list[Vector] = []

    def valid(samples: Vector) -> Mask:
        asked.append(samples)
        return everywhere(samples)

    space = FreeSpace(problem(valid, resolution=resolution))
    found = []
    for line in ([start, end], [end, start]):
        asked.clear()
        space.path(np.array(line))
        found.append({sample.tobytes() for batch in asked for sample in batch})
    assert found[0] == found[1]


@given(points, points, points, st.floats(0.01, 0.3))
def test_a_line_is_free_where_all_its_samples_are(start, end, centre, radius) -> None:
    def valid(samples: Vector) -> Mask:
        return np.linalg.norm(samples - centre, axis=1) > radius

    steps = max(1, int(np.ceil(np.abs(end - start).sum() / 0.05)))
    samples = [start, *((start * (steps - i) + end * i) / steps for i in range(1, steps)), end]
    assert FreeSpace(problem(valid)).path(np.array([start, end])) == valid(np.array(samples)).all()


def test_a_blocked_line_is_left_early() -> None:
    space = FreeSpace(problem(lambda samples: samples[:, 0] < 0.4, resolution=1e-4))
    assert not space.path(np.array([[0.0, 0.0], [0.9, 0.0]]))
    assert space.checks < 9000 / 10


# ---- start and goals -----------------------------------------------------------------------------------------------


@given(st.lists(st.tuples(values, values), min_size=1, max_size=5), values, values)
def test_the_free_goals_are_told_by_number_or_why_there_are_none(goals, start_limit, goal_limit) -> None:
    def valid(samples: Vector) -> Mask:
        return np.where((samples == 0).all(axis=1), start_limit > 0.5, samples[:, 0] > goal_limit)

    found = FreeSpace(problem(valid, goals)).free_goals()
    free = valid(np.array(goals))
    if not valid(np.zeros((1, 2)))[0]:
        assert isinstance(found, Failure)
        assert found.kind is FailureKind.START_IN_COLLISION
        assert found.configuration == (0.0, 0.0)
    elif not free.any():
        assert isinstance(found, Failure)
        assert found.kind is FailureKind.GOAL_IN_COLLISION
        assert found.configuration in goals
    else:
        assert list(found) == list(np.flatnonzero(free))


def test_contacts_come_deepest_first_and_each_object_once() -> None:
    contacts = (Contact("point", "b", 0.01), Contact("point", "a", 0.03), Contact("tail", "b", 0.02))
    found = FreeSpace(problem(lambda samples: samples[:, 0] > 0.5, explain=lambda _: contacts)).free_goals()
    assert isinstance(found, Failure)
    assert found.objects == ("a", "b")
    assert [contact.depth for contact in found.contacts] == [0.03, 0.02, 0.01]


def test_of_goals_in_collision_the_one_nearest_to_free_is_explained() -> None:
    depths = {0.6: 0.05, 0.7: 0.01, 0.8: 0.02}

    def explain(point: Vector) -> tuple[Contact, ...]:
        depth = depths.get(float(point[0]))
        return () if depth is None else (Contact("point", f"at {point[0]}", depth),)

    goals = [(0.9, 0.2), *((x, 0.2) for x in depths)]
    found = FreeSpace(problem(lambda samples: samples[:, 0] < 0.5, goals, explain=explain)).free_goals()
    assert isinstance(found, Failure)
    assert found.configuration == (0.7, 0.2)
    assert [contact.object for contact in found.contacts] == ["at 0.7"]
    assert found.objects == ("at 0.7", "at 0.6", "at 0.8")


def test_objects_come_by_how_many_goals_they_are_in_the_way_of() -> None:
    touched = {0.6: {"a": 0.01}, 0.7: {"b": 0.02, "c": 0.03}, 0.8: {"b": 0.04}}

    def explain(point: Vector) -> tuple[Contact, ...]:
        return tuple(Contact("point", name, depth) for name, depth in touched[float(point[0])].items())

    goals = [(x, 0.2) for x in touched]
    found = FreeSpace(problem(lambda samples: samples[:, 0] < 0.5, goals, explain=explain)).free_goals()
    assert isinstance(found, Failure)
    assert found.objects == ("b", "a", "c")
    assert found.measures == {"configurations": 3, "hit_share": 2 / 3}


# ---- malformed problems --------------------------------------------------------------------------------------------


@pytest.mark.parametrize(
    ("others", "sentence"),
    [
        (
            {"high": np.array([1.0, np.inf])},
            "joint limits must be finite and low <= high, not low=[0.0, 0.0], high=[1.0, inf].",
        ),
        (
            {"high": np.array([1.0, -1.0])},
            "joint limits must be finite and low <= high, not low=[0.0, 0.0], high=[1.0, -1.0].",
        ),
        ({"resolution": 0.0}, "the resolution must be positive in every joint, not [0.0, 0.0]."),
        (
            {"valid": lambda samples: np.ones((len(samples), 2))},
            "the validity test must answer 2 configurations with shape (2,), not (2, 2).",
        ),
    ],
)
def test_a_malformed_problem_is_the_programs_fault(others, sentence) -> None:
    with pytest.raises(PluginError) as caught:
        FreeSpace(problem(**others)).free_goals()
    assert str(caught.value) == sentence


def test_a_malformed_answer_about_a_line_is_the_programs_fault() -> None:
    space = FreeSpace(problem(resolution=0.05, uncertain=lambda start, end, steps: np.ones(steps)))
    with pytest.raises(PluginError) as caught:
        space.path(np.array([(0.0, 0.0), (1.0, 0.0)]))
    assert str(caught.value) == "`uncertain` must answer 20 steps with shape (21,), not (20,)."
