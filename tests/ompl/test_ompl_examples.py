"""Worlds that are known, and the ways in which OMPL could break a promise."""

from __future__ import annotations

import subprocess
import sys
from itertools import count

import numpy as np
import pytest
from disc_worlds import LEFT, NAMES, RIGHT, in_square, plan, wall
from ompl import util

from llm3.errors import PluginError
from llm3.types import Contact, Failure, FailureKind, Mask, Path, Vector

each_planner = pytest.mark.parametrize("name", NAMES)


def everywhere(points: Vector) -> Mask:
    return np.ones(len(points), dtype=bool)


def shut(points: Vector) -> Mask:
    return wall(2.0, 2.0)(points)


# ---- paths ---------------------------------------------------------------------------------------------------------


@each_planner
def test_a_free_straight_way_is_taken_without_a_search(name: str) -> None:
    path = plan(name, in_square(everywhere))
    assert isinstance(path, Path)
    assert np.array_equal(path.waypoints, [LEFT, RIGHT])
    assert path.stats.planner_iterations == 0


@each_planner
def test_a_straight_way_to_a_lesser_goal_wins_over_a_search(name: str) -> None:
    path = plan(name, in_square(shut, (0.5, 0.5), RIGHT, (0.2, 0.8)))
    assert isinstance(path, Path)
    assert path.goal_index == 2


@each_planner
def test_a_search_names_the_goal_that_it_reached(name: str) -> None:
    def two_rooms(points: Vector) -> Mask:  # the first goal's room is shut
        return wall(0.6, 0.9)(points) & ~((points[:, 0] > 0.55) & (np.abs(points[:, 1] - 0.15) < 0.02))

    path = plan(name, in_square(two_rooms, (0.8, 0.1), (0.8, 0.2), (0.8, 0.2)))
    assert isinstance(path, Path)
    assert path.goal_index in (1, 2)
    assert tuple(path.waypoints[-1]) == (0.8, 0.2)
    assert path.stats.planner_iterations > 0


@each_planner
def test_paths_around_a_wall_are_short(name: str) -> None:
    corners = np.array([LEFT, (0.45, 0.6), (0.55, 0.6), RIGHT])
    optimum = np.linalg.norm(np.diff(corners, axis=0), axis=1).sum()
    answers = [plan(name, in_square(wall(0.6, 0.9)), seed, iterations=600) for seed in range(5)]
    lengths = [path.length for path in answers if isinstance(path, Path)]
    assert len(lengths) == 5
    assert np.median(lengths) < 1.2 * optimum


@each_planner
def test_no_waypoint_comes_twice_in_a_row(name: str) -> None:
    for seed in range(5):
        path = plan(name, in_square(wall(0.6, 0.9)), seed, iterations=600)
        assert isinstance(path, Path)
        assert (np.linalg.norm(np.diff(path.waypoints, axis=0), axis=1) > 0).all()


@each_planner
def test_ends_a_little_beyond_the_limits_are_taken_as_they_are_and_nothing_else_is(name: str) -> None:
    start, goal = (-1e-4, 0.2), (1.0001, 0.2)
    path = plan(name, in_square(wall(0.6, 0.9), goal, start=start), iterations=600)
    assert isinstance(path, Path)
    assert (tuple(path.waypoints[0]), tuple(path.waypoints[-1])) == (start, goal)
    assert ((path.waypoints[1:-1] >= 0) & (path.waypoints[1:-1] <= 1)).all()


@each_planner
def test_a_fixed_joint_does_not_move(name: str) -> None:
    limits = {"low": np.array([0.0, 0.0, 0.3]), "high": np.array([1.0, 1.0, 0.3])}
    path = plan(name, in_square(wall(0.6, 0.9), (*RIGHT, 0.3), start=(*LEFT, 0.3), **limits), iterations=600)
    assert isinstance(path, Path)
    assert (path.waypoints[:, 2] == 0.3).all()


# ---- no path -------------------------------------------------------------------------------------------------------


@each_planner
def test_what_comes_near_a_goal_is_no_path(name: str) -> None:
    def all_but_enclosed(points: Vector) -> Mask:
        return np.abs(np.linalg.norm(points - RIGHT, axis=1) - 0.1) > 0.05

    failure = plan(name, in_square(all_but_enclosed), iterations=200)
    assert isinstance(failure, Failure)
    assert failure.kind is FailureKind.NO_PATH
    assert failure.measures == {"iterations": 200}
    assert failure.stats.planner_iterations == 200


@each_planner
def test_a_budget_of_nothing_is_no_search(name: str) -> None:
    failure = plan(name, in_square(shut), iterations=0)
    assert isinstance(failure, Failure)
    assert failure.measures == {"iterations": 0}


@each_planner
def test_the_clock_ends_a_search_and_the_query_is_marked(name: str) -> None:
    ticks = count()
    failure = plan(name, in_square(shut), iterations=10**9, max_seconds=50.0, clock=lambda: float(next(ticks)))
    assert isinstance(failure, Failure)
    assert failure.kind is FailureKind.NO_PATH
    assert failure.stats.time_limited == 1
    assert failure.stats.planner_iterations == 49


def test_the_clock_ends_the_simplifying_but_the_path_stands() -> None:
    problem = in_square(wall(0.6, 0.9))
    whole = plan("ompl-rrtconnect", problem)
    ticks, needed = count(), whole.stats.planner_iterations + 1
    cut = plan("ompl-rrtconnect", problem, max_seconds=float(needed), clock=lambda: float(next(ticks)))
    assert isinstance(cut, Path)
    assert isinstance(whole, Path)
    assert (cut.stats.time_limited, whole.stats.time_limited) == (1, 0)
    assert whole.length < cut.length


@each_planner
def test_a_path_that_fails_a_second_test_is_not_returned(name: str) -> None:
    asked = 0

    def fickle(points: Vector) -> Mask:  # a world in which everything is free for as long as the search lasts
        nonlocal asked
        asked += len(points)
        return wall(0.6, 0.9)(points) if asked < whole.stats.validity_checks - 10 else np.zeros(len(points), dtype=bool)

    whole = plan(name, in_square(wall(0.6, 0.9)))
    assert isinstance(whole, Path)
    failure = plan(name, in_square(fickle))
    assert isinstance(failure, Failure)
    assert failure.kind is FailureKind.NO_PATH


def test_a_goal_in_collision_is_explained_without_a_search() -> None:
    contacts = (Contact("point", "b", 0.01), Contact("point", "a", 0.03))
    failure = plan("ompl-rrtconnect", in_square(lambda points: points[:, 0] < 0.5, explain=lambda _: contacts))
    assert isinstance(failure, Failure)
    assert failure.kind is FailureKind.GOAL_IN_COLLISION
    assert failure.objects == ("a", "b")
    assert (failure.stats.planner_calls, failure.stats.planner_iterations) == (1, 0)


# ---- what comes from OMPL ------------------------------------------------------------------------------------------


@each_planner
def test_whoever_used_ompl_before_changes_no_path(name: str) -> None:
    problem = in_square(wall(0.6, 0.9))
    before = plan(name, problem)
    util.RNG().uniform01()
    plan(name, in_square(shut), seed=5)
    after = plan(name, problem)
    assert isinstance(before, Path)
    assert isinstance(after, Path)
    assert np.array_equal(before.waypoints, after.waypoints)


PRINTS_PATHS = """
from disc_worlds import NAMES, in_square, plan, wall
print([plan(name, in_square(wall(0.6, 0.9)), seed).waypoints.tolist() for name in NAMES for seed in range(2)])
"""


def test_another_process_finds_the_same_paths_and_nothing_else_is_printed() -> None:
    paths = "import sys; sys.path[:0] = " + repr(sys.path)
    run = subprocess.run([sys.executable, "-c", paths + PRINTS_PATHS], capture_output=True, text=True, check=True)
    problem = in_square(wall(0.6, 0.9))
    found = [plan(name, problem, seed).waypoints.tolist() for name in NAMES for seed in range(2)]
    assert (run.stdout, run.stderr) == (f"{found}\n", "")


@each_planner
def test_ompl_is_silent_and_gets_its_log_level_back(name: str, capfd) -> None:
    util.setLogLevel(util.LOG_DEBUG)
    try:
        plan(name, in_square(wall(0.6, 0.9)))
        plan(name, in_square(shut), iterations=10)
        assert util.getLogLevel() == util.LOG_DEBUG
    finally:
        util.setLogLevel(util.LOG_INFO)
    assert capfd.readouterr() == ("", "")


@each_planner
@pytest.mark.parametrize("kind", [RuntimeError, KeyboardInterrupt])
def test_an_error_in_the_validity_test_ends_the_query_as_it_is(name: str, kind: type[BaseException]) -> None:
    calls = count()

    def breaks(points: Vector) -> Mask:
        if next(calls) == 15:
            raise kind("in the simulator")
        return wall(0.6, 0.63)(points)

    with pytest.raises(kind, match=r"^in the simulator$"):
        plan(name, in_square(breaks))
    assert isinstance(plan(name, in_square(wall(0.6, 0.9))), Path)  # the next query is as good as any


def test_a_malformed_problem_is_the_programs_fault() -> None:
    with pytest.raises(PluginError) as caught:
        plan("ompl-rrtconnect", in_square(everywhere, resolution=0.0))
    assert str(caught.value) == "the resolution must be positive in every joint, not [0.0, 0.0]."
