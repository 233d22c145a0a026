"""Worlds that are known: a wall with a gap, a narrow passage, a closed box."""

from __future__ import annotations

import dataclasses
from itertools import count

import numpy as np
import pytest

from llm3.errors import PluginError
from llm3.interfaces import PlannerSettings
from llm3.types import Contact, Failure, FailureKind, Goal, Mask, MotionProblem, Path, Vector
from llm3.types.motion import Goals
from llm3_birrt import plugin
from llm3_birrt.evidence import MAX_EXPLAINED
from llm3_birrt.joint_space import JointSpace
from llm3_birrt.planner import BiRRT

LEFT, RIGHT = (0.2, 0.2), (0.8, 0.2)
SETTINGS = PlannerSettings(max_iterations=2000, max_seconds=np.inf)


def wall(gap_low: float, gap_high: float):
    """A wall across the unit square at x = 0.45 .. 0.55, with a gap in y."""

    def valid(points: Vector) -> Mask:
        x, y = points.T
        return (x < 0.45) | (x > 0.55) | ((y > gap_low) & (y < gap_high))

    return valid


def problem(valid, *goals: tuple[float, float], resolution: float = 0.01, **others) -> MotionProblem:
    return MotionProblem(
        np.array(LEFT),
        tuple(Goal(goal) for goal in goals or (RIGHT,)),
        low=np.zeros(2),
        high=np.ones(2),
        valid=valid,
        resolution=np.full(2, resolution),
        **others,
    )


def plan(query: MotionProblem, seed: int = 0, settings: PlannerSettings = SETTINGS) -> Path | Failure:
    return BiRRT(settings).plan(query, np.random.default_rng(seed))


def everywhere(points: Vector) -> Mask:
    return np.ones(len(points), dtype=bool)


def shut(points: Vector) -> Mask:
    return wall(2.0, 2.0)(points)


def test_a_free_straight_way_is_taken_without_a_search() -> None:
    path = plan(problem(everywhere))
    assert isinstance(path, Path)
    assert np.array_equal(path.waypoints, [LEFT, RIGHT])
    assert path.stats.planner_iterations == 0


def test_a_goal_at_the_start_is_a_path_of_no_length() -> None:
    path = plan(problem(everywhere, LEFT))
    assert isinstance(path, Path)
    assert np.array_equal(path.waypoints, [LEFT, LEFT])


def test_of_two_straight_ways_the_preferred_one_is_taken() -> None:
    path = plan(problem(everywhere, RIGHT, (0.2, 0.3)))
    assert isinstance(path, Path)
    assert path.goal_index == 0


def test_a_straight_way_to_a_lesser_goal_wins_over_a_search() -> None:
    path = plan(problem(shut, RIGHT, (0.2, 0.8)))
    assert isinstance(path, Path)
    assert path.goal_index == 1


def test_goals_behind_one_with_a_straight_way_are_not_looked_at() -> None:
    made = []

    def goals():
        for goal in (RIGHT, (0.2, 0.3)):
            made.append(goal)
            yield Goal(goal)

    query = dataclasses.replace(problem(everywhere), goals=Goals(goals()))
    assert isinstance(plan(query), Path)
    assert made == [RIGHT]


def test_a_goal_that_is_not_free_keeps_its_number() -> None:
    path = plan(problem(shut, (0.5, 0.5), (0.2, 0.8)))
    assert isinstance(path, Path)
    assert path.goal_index == 1


def test_a_search_names_the_goal_that_it_reached() -> None:
    def two_rooms(points: Vector) -> Mask:  # the first goal's room is shut
        return wall(0.6, 0.9)(points) & ~((points[:, 0] > 0.55) & (np.abs(points[:, 1] - 0.15) < 0.02))

    path = plan(problem(two_rooms, (0.8, 0.1), (0.8, 0.2)))
    assert isinstance(path, Path)
    assert path.goal_index == 1
    assert tuple(path.waypoints[-1]) == (0.8, 0.2)
    assert path.stats.planner_iterations > 0


def test_paths_around_a_wall_are_short() -> None:
    corners = np.array([LEFT, (0.45, 0.6), (0.55, 0.6), RIGHT])
    optimum = np.linalg.norm(np.diff(corners, axis=0), axis=1).sum()
    query = problem(wall(0.6, 0.9))
    lengths = [path.length for seed in range(20) if isinstance(path := plan(query, seed), Path)]
    assert len(lengths) == 20
    assert np.median(lengths) < 1.5 * optimum


@pytest.mark.parametrize("seed", range(10))
def test_a_narrow_passage_is_found_with_any_luck(seed: int) -> None:
    path = plan(problem(wall(0.60, 0.63), resolution=0.005), seed)
    assert isinstance(path, Path)


@pytest.mark.parametrize("seed", range(3))
def test_a_larger_budget_never_leaves_a_larger_gap(seed: int) -> None:
    budgets = [PlannerSettings(max_iterations=n, max_seconds=np.inf) for n in (0, 50, 250, 400, 800)]
    failures = [plan(problem(shut), seed, budget) for budget in budgets]
    gaps = [failure.measures["gap"] for failure in failures if isinstance(failure, Failure)]
    assert len(gaps) == len(budgets)
    assert gaps == sorted(gaps, reverse=True)


@pytest.mark.parametrize("seed", range(5))
def test_every_sample_of_a_path_was_tested(seed: int) -> None:
    tested: set[tuple[float, ...]] = set()
    free = wall(0.6, 0.9)

    def key(point: Vector) -> tuple[float, ...]:
        return tuple(np.round(point, 9).tolist())

    def recording(points: Vector) -> Mask:
        tested.update(map(key, points))
        return free(points)

    query = problem(recording, resolution=0.03)
    path = plan(query, seed)
    assert isinstance(path, Path)
    assert len(path.waypoints) > 2
    remembered = JointSpace(problem(lambda points: [key(p) in tested for p in points], resolution=0.03))
    edges = zip(path.waypoints[:-1], path.waypoints[1:], strict=True)
    assert all(remembered.obstacle(a, b) is None for a, b in edges)


def test_a_thin_obstacle_on_a_long_edge_is_not_missed() -> None:
    def thin_wall(points: Vector) -> Mask:
        return np.abs(points[:, 0] - 0.41) > 2e-4

    failure = plan(problem(thin_wall, resolution=2e-4), settings=PlannerSettings(max_iterations=0))
    assert isinstance(failure, Failure)
    assert failure.kind is FailureKind.NO_PATH


def test_a_start_in_collision_is_explained() -> None:
    contacts = (Contact("point", "b", 0.01), Contact("point", "a", 0.03), Contact("tail", "b", 0.02))
    failure = plan(problem(lambda points: points[:, 0] > 0.5, explain=lambda _: contacts))
    assert isinstance(failure, Failure)
    assert failure.kind is FailureKind.START_IN_COLLISION
    assert failure.objects == ("a", "b")
    assert [contact.depth for contact in failure.contacts] == [0.03, 0.02, 0.01]
    assert failure.stats.planner_calls == 1


def test_of_goals_in_collision_the_one_nearest_to_free_is_explained_that_touches_what_blocks_most_of_them() -> None:
    touched = {
        0.6: {"wall": 0.05},
        0.7: {"shelf": 0.01},
        0.8: {"wall": 0.02, "shelf": 0.005, "lamp": 0.01},
        0.9: {"wall": 0.03},
    }

    def explain(point: Vector) -> tuple[Contact, ...]:
        depths = touched.get(float(point[0]), {})
        return tuple(Contact("point", name, depth) for name, depth in depths.items())

    goals = [(1.0, 0.2), *((x, 0.2) for x in touched)]
    failure = plan(problem(lambda points: points[:, 0] < 0.5, *goals, explain=explain))
    assert isinstance(failure, Failure)
    assert failure.kind is FailureKind.GOAL_IN_COLLISION
    assert failure.configuration == (0.8, 0.2)
    assert [contact.object for contact in failure.contacts] == ["wall", "lamp", "shelf"]
    assert failure.objects == ("wall", "shelf", "lamp")
    assert failure.measures == {"configurations": 5, "hit_share": 3 / 5}


def test_a_failed_search_says_how_far_it_came() -> None:
    failure = plan(problem(shut), settings=PlannerSettings(max_iterations=100, max_seconds=np.inf))
    assert isinstance(failure, Failure)
    assert failure.kind is FailureKind.NO_PATH
    assert set(failure.measures) == {"iterations", "start_tree", "goal_tree", "gap", "stops"}
    assert failure.measures["iterations"] == failure.stats.planner_iterations == 100
    assert failure.measures["start_tree"] > 1
    assert failure.measures["goal_tree"] > 1
    assert 0.1 <= failure.measures["gap"] <= 0.6  # the wall's width; from start to goal
    assert failure.stats.time_limited == 0


def test_a_failed_search_names_what_stopped_it_the_most_frequent_first() -> None:
    walls = {"low wall": lambda y: y < 0.7, "high wall": lambda y: y >= 0.7, "door": lambda y: y > 0.99}

    def explain(point: Vector) -> tuple[Contact, ...]:
        x, y = point
        return tuple(Contact("point", name, 0.05 - abs(x - 0.5)) for name, part in walls.items() if part(y))

    failure = plan(problem(shut, explain=explain), settings=PlannerSettings(max_iterations=200, max_seconds=np.inf))
    assert isinstance(failure, Failure)
    assert failure.objects == ("low wall", "high wall")  # the door is hit too seldom to be to blame
    assert 0.5 < failure.measures["hit_share"] < 1.0


def test_a_failed_search_tells_what_touches_where_it_came_nearest() -> None:
    def explain(point: Vector) -> tuple[Contact, ...]:
        return Contact("point", "wall", 0.01), Contact("tail", "wall", 0.02)

    failure = plan(problem(shut, explain=explain), settings=PlannerSettings(max_iterations=50, max_seconds=np.inf))
    assert isinstance(failure, Failure)
    assert not shut(np.array([failure.configuration]))[0]
    assert [contact.depth for contact in failure.contacts] == [0.02, 0.01]
    assert failure.objects == ("wall",)
    assert failure.measures["hit_share"] == 1.0


def test_a_failed_search_explains_a_bounded_number_of_configurations() -> None:
    explained = []
    settings = PlannerSettings(max_iterations=500, max_seconds=np.inf)
    failure = plan(problem(shut, explain=lambda q: explained.append(q) or ()), settings=settings)
    assert isinstance(failure, Failure)
    assert failure.measures["stops"] > MAX_EXPLAINED
    assert len(explained) == MAX_EXPLAINED + 1
    assert failure.objects == failure.contacts == ()


def test_without_iterations_what_blocks_the_straight_way_is_told() -> None:
    failure = plan(problem(shut, explain=lambda _: (Contact("point", "wall"),)), settings=PlannerSettings(0))
    assert isinstance(failure, Failure)
    assert failure.objects == ("wall",)
    assert not shut(np.array([failure.configuration]))[0]
    assert failure.measures["stops"] == 1


def test_without_iterations_the_gap_is_the_distance_to_the_nearest_goal() -> None:
    query = problem(shut, (0.9, 0.2), RIGHT)
    failure = plan(query, settings=PlannerSettings(max_iterations=0))
    assert isinstance(failure, Failure)
    assert failure.measures["gap"] == pytest.approx(0.6)


def test_the_clock_ends_a_search_and_the_query_is_marked() -> None:
    ticks = count()
    settings = PlannerSettings(max_iterations=10**9, max_seconds=50.0, clock=lambda: float(next(ticks)))
    failure = plan(problem(shut), settings=settings)
    assert isinstance(failure, Failure)
    assert failure.kind is FailureKind.NO_PATH
    assert failure.stats.time_limited == 1
    assert failure.stats.planner_iterations == 49


def test_the_clock_ends_the_smoothing_but_the_path_stands() -> None:
    query = problem(wall(0.6, 0.9))
    whole = plan(query)
    ticks = count()
    needed = whole.stats.planner_iterations + 1
    settings = PlannerSettings(max_seconds=float(needed), clock=lambda: float(next(ticks)))
    cut = plan(query, settings=settings)
    assert isinstance(cut, Path)
    assert isinstance(whole, Path)
    assert (cut.stats.time_limited, whole.stats.time_limited) == (1, 0)
    assert whole.length <= cut.length
    assert (np.linalg.norm(np.diff(cut.waypoints, axis=0), axis=1) > 0).all()  # the trees' meeting point counts once


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
            {"valid": lambda points: np.ones((len(points), 2))},
            "the validity test must answer 1 configurations with shape (1,), not (1, 2).",
        ),
    ],
)
def test_a_malformed_problem_is_the_programs_fault(others, sentence: str) -> None:
    fields = {"low": np.zeros(2), "high": np.ones(2), "valid": everywhere, "resolution": 0.01} | others
    with pytest.raises(PluginError) as error:
        plan(MotionProblem(np.array(LEFT), (Goal(RIGHT),), **fields))
    assert str(error.value) == sentence


def test_the_plugin_offers_the_planner() -> None:
    planner = plugin.llm3_planners()["birrt"](SETTINGS)
    assert isinstance(planner, BiRRT)
