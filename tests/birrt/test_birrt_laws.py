"""What holds of every path, in worlds of random discs."""

from __future__ import annotations

import dataclasses
from collections.abc import Callable

import numpy as np
import pytest
from hypothesis import assume, given, settings
from hypothesis import strategies as st

from llm3.interfaces import PlannerSettings
from llm3.types import Contact, Failure, FailureKind, Goal, Mask, MotionProblem, Path, Vector
from llm3_birrt.planner import BiRRT

RESOLUTION = 0.05
"""Metres. Where every sample is this far from a disc, no point between two samples is inside it."""
QUICK = settings(deadline=None, max_examples=60)

coordinates = st.floats(0.0, 1.0).map(lambda x: round(x, 3))
points = st.tuples(coordinates, coordinates)
Discs = list[tuple[float, float, float]]
disc_lists = st.lists(st.tuples(coordinates, coordinates, st.floats(0.02, 0.25)), max_size=6)


def inflated_by(margin: float, discs: Discs) -> Callable[[Vector], Vector]:
    """The validity of points (N, 2) that have to stay this far from all discs."""
    world = np.array(discs).reshape(-1, 3)

    def valid(points: Vector) -> Vector:
        distances = np.linalg.norm(points[:, None] - world[:, :2], axis=2)
        return (distances > world[:, 2] + margin).all(axis=1)

    return valid


def problem_of(start: tuple[float, float], goals: list[tuple[float, float]], discs: Discs) -> MotionProblem:
    def explain(point: Vector) -> tuple[Contact, ...]:
        depths = {
            f"disc {i}": r + RESOLUTION - np.hypot(x - point[0], y - point[1]) for i, (x, y, r) in enumerate(discs)
        }
        return tuple(Contact("point", name, float(depth)) for name, depth in depths.items() if depth >= 0)

    return MotionProblem(
        start=np.array(start),
        goals=tuple(Goal(goal) for goal in goals),
        low=np.zeros(2),
        high=np.ones(2),
        valid=inflated_by(RESOLUTION, discs),
        resolution=np.full(2, RESOLUTION),
        explain=explain,
    )


problems = st.builds(problem_of, points, st.lists(points, min_size=1, max_size=4), disc_lists)


def plan(problem: MotionProblem, seed: int = 0, iterations: int = 200) -> Path | Failure:
    planner = BiRRT(PlannerSettings(max_iterations=iterations, max_seconds=np.inf))
    return planner.plan(problem, np.random.default_rng(seed))


def sampled(path: Path, finer: int) -> Vector:
    """Points along the path, `finer` times closer than the resolution demands."""
    pieces = []
    for a, b in zip(path.waypoints[:-1], path.waypoints[1:], strict=True):
        steps = max(1, int(np.ceil(np.abs(b - a).sum() / RESOLUTION - 1e-6))) * finer
        pieces.append(a + (b - a) * np.linspace(0.0, 1.0, steps + 1)[:, None])
    return np.vstack(pieces)


@given(disc_lists, points, st.lists(points, min_size=1, max_size=4), st.integers(0, 9))
@QUICK
def test_a_path_joins_the_start_and_the_goal_that_it_names(discs, start, goals, seed) -> None:
    path = plan(problem_of(start, goals, discs), seed)
    assume(isinstance(path, Path))
    assert tuple(path.waypoints[0]) == start
    assert tuple(path.waypoints[-1]) == goals[path.goal_index]


@given(problems, st.integers(0, 9))
@QUICK
def test_a_path_stays_within_the_limits(problem, seed) -> None:
    path = plan(problem, seed)
    assume(isinstance(path, Path))
    assert (path.waypoints >= problem.low).all()
    assert (path.waypoints <= problem.high).all()


@given(problems, st.integers(0, 9))
@QUICK
def test_a_path_is_valid_at_the_resolution(problem, seed) -> None:
    path = plan(problem, seed)
    assume(isinstance(path, Path))
    assert problem.valid(sampled(path, finer=1)).all()


@given(disc_lists, points, points, st.integers(0, 9))
@QUICK
def test_a_margin_of_the_resolution_makes_up_for_what_lies_between_samples(discs, start, goal, seed) -> None:
    path = plan(problem_of(start, [goal], discs), seed)
    assume(isinstance(path, Path))
    assert inflated_by(0.0, discs)(sampled(path, finer=4)).all()


@given(problems, st.integers(0, 9))
@QUICK
def test_the_same_generator_state_gives_the_same_answer(problem, seed) -> None:
    first, second = plan(problem, seed), plan(problem, seed)
    assert type(first) is type(second)
    if isinstance(first, Path) and isinstance(second, Path):
        assert np.array_equal(first.waypoints, second.waypoints)
        assert (first.goal_index, first.stats) == (second.goal_index, second.stats)
    else:
        assert first == second
        assert first.stats == second.stats


@given(problems, st.integers(0, 9))
@QUICK
def test_knowing_what_is_certainly_free_saves_tests_and_changes_nothing_else(problem, seed) -> None:
    def uncertain(start: Vector, end: Vector, steps: int) -> Mask:
        line = start + np.linspace(0.0, 1.0, steps + 1)[:, None] * (end - start)
        around = np.array([[0.0, 0.0], [1e-9, 0.0], [-1e-9, 0.0], [0.0, 1e-9], [0.0, -1e-9]])
        inside = ((line >= 0.0) & (line <= 1.0)).all(axis=1)
        return ~np.all([problem.valid(line + offset) for offset in around], axis=0) | ~inside | (line[:, 0] < 0.3)

    told, untold = plan(dataclasses.replace(problem, uncertain=uncertain), seed), plan(problem, seed)
    assert told.stats.validity_checks <= untold.stats.validity_checks
    assert told.stats.planner_iterations == untold.stats.planner_iterations
    assert type(told) is type(untold)
    if isinstance(told, Path) and isinstance(untold, Path):
        assert np.array_equal(told.waypoints, untold.waypoints)
    else:
        assert told == untold


@given(problems, st.integers(0, 9))
@QUICK
def test_what_was_spent_is_told(problem, seed) -> None:
    tested = []

    def counted(points: Vector) -> Vector:
        tested.append(len(points))
        return problem.valid(points)

    stats = plan(dataclasses.replace(problem, valid=counted), seed, iterations=50).stats
    assert stats.planner_calls == 1
    assert stats.planner_iterations <= 50
    assert stats.validity_checks == sum(tested)
    assert min(tested) > 0  # nobody is asked about nothing
    assert stats.time_limited == 0


@given(disc_lists, points, st.lists(points, min_size=1, max_size=4), st.randoms(use_true_random=False))
@QUICK
def test_the_order_of_the_goals_decides_nothing_but_the_preference(discs, start, goals, random) -> None:
    shuffled = random.sample(goals, len(goals))
    kinds = [
        answer.kind if isinstance(answer, Failure) else "a straight way" if len(answer.waypoints) == 2 else "a path"
        for answer in (plan(problem_of(start, order, discs), iterations=0) for order in (goals, shuffled))
    ]
    assert kinds[0] == kinds[1]


@given(disc_lists, points, st.lists(points, min_size=1, max_size=3))
@QUICK
def test_a_goal_given_twice_changes_nothing_that_is_reached_straight(discs, start, goals) -> None:
    once, twice = (plan(problem_of(start, order, discs), iterations=0) for order in (goals, goals + goals))
    if isinstance(once, Path) and isinstance(twice, Path):
        assert once.goal_index == twice.goal_index
        assert np.array_equal(once.waypoints, twice.waypoints)
    else:
        assert once.kind is twice.kind
        assert (once.objects, once.contacts) == (twice.objects, twice.contacts)


@given(problems)
@QUICK
def test_failures_are_what_they_are_called(problem) -> None:
    goals = np.array([goal.configuration for goal in problem.goals])
    start_free, goals_free = problem.valid(problem.start[None])[0], problem.valid(goals)
    answer = plan(problem, iterations=20)
    if not start_free:
        assert isinstance(answer, Failure)
        assert answer.kind is FailureKind.START_IN_COLLISION
    elif not goals_free.any():
        assert isinstance(answer, Failure)
        assert answer.kind is FailureKind.GOAL_IN_COLLISION
    elif isinstance(answer, Failure):
        assert answer.kind is FailureKind.NO_PATH
    else:
        assert goals_free[answer.goal_index]


@given(points, st.lists(points, min_size=1, max_size=4), disc_lists, st.booleans())
@QUICK
def test_collisions_name_what_is_touched_the_deepest_first(start, goals, discs, at_start) -> None:
    in_the_way = [(x, y, 0.1) for x, y in ([start] if at_start else goals)]
    problem = problem_of(start, goals, [*discs, *in_the_way])
    answer = plan(problem, iterations=0)
    assert isinstance(answer, Failure)
    depths = [contact.depth for contact in answer.contacts]
    assert depths
    assert depths == sorted(depths, reverse=True)
    assert set(answer.objects) >= {contact.object for contact in answer.contacts}
    of_each = [{c.object for c in problem.explain(q)} for q in _blamed(problem, answer.kind)]
    shares = [sum(name in touched for touched in of_each) / len(of_each) for name in answer.objects]
    assert shares == sorted(shares, reverse=True)
    assert answer.measures == {"configurations": len(of_each), "hit_share": shares[0]}


def _blamed(problem: MotionProblem, kind: FailureKind) -> list[Vector]:
    if kind is FailureKind.START_IN_COLLISION:
        return [problem.start]
    return [np.array(goal.configuration) for goal in problem.goals]


@given(st.floats(0.0, 0.25), coordinates, coordinates, st.integers(0, 9), st.integers(0, 50))
@QUICK
def test_a_failed_search_tells_a_configuration_that_is_blocked_and_by_what(x, y, other, seed, iterations) -> None:
    wall = [(0.5, y, 0.15) for y in (0.0, 0.25, 0.5, 0.75, 1.0)]
    problem = problem_of((x, y), [(1.0 - x, other)], wall)
    failure = plan(problem, seed, iterations)
    assert isinstance(failure, Failure)
    assert failure.kind is FailureKind.NO_PATH
    assert not problem.valid(np.array([failure.configuration]))[0]
    assert {contact.object for contact in failure.contacts} == {
        contact.object for contact in problem.explain(np.array(failure.configuration))
    }
    assert set(failure.objects) <= {f"disc {i}" for i in range(len(wall))}
    assert failure.objects
    assert 0.2 <= failure.measures["hit_share"] <= 1.0  # of five discs, one is hit so often


@pytest.mark.parametrize("seed", range(3))
def test_seven_joints_are_planned_as_two_are(seed: int) -> None:
    def valid(q: Vector) -> Vector:
        return np.abs(np.linalg.norm(q[:, :6], axis=1) - 2.0) > 0.2  # a shell around the start ...

    def with_a_door(q: Vector) -> Vector:
        return valid(q) | (q[:, 6] > 1.5)  # ... which the last joint opens

    goal = (2.0, 2.0, 0.0, 0.0, 0.0, 0.0, 0.0)
    problem = MotionProblem(
        np.zeros(7), (Goal(goal),), np.full(7, -2.8), np.full(7, 2.8), with_a_door, np.full(7, 0.05)
    )
    path = plan(problem, seed, iterations=2000)
    assert isinstance(path, Path)
    assert len(path.waypoints) > 2
    assert tuple(path.waypoints[-1]) == goal
    assert with_a_door(sampled(path, finer=1)).all()
