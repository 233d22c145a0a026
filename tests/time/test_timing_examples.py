"""Trajectories whose figures can be worked out by hand, and what reads or breaks easily."""

from __future__ import annotations

import numpy as np
import pytest

from llm3.types import Trajectory
from llm3_time.timer import ToppraTimer

ARC = np.linspace(0.0, 1.5, 31)
"""Angles of waypoints on a circle, a little less than three degrees apart; both joints go one way only."""


def time(waypoints, velocity=2.0, acceleration=8.0) -> Trajectory:
    waypoints = np.array(waypoints, dtype=float)
    dof = waypoints.shape[1]
    return ToppraTimer().time(waypoints, np.full(dof, velocity), np.full(dof, acceleration))


def stops(trajectory: Trajectory) -> list[tuple[float, ...]]:
    """Where the robot stands still."""
    pairs = zip(trajectory.positions, trajectory.velocities, strict=True)
    return [position for position, velocity in pairs if not any(velocity)]


@pytest.mark.parametrize(
    ("distance", "seconds", "samples"),
    [(0.08, 0.2, 3), (0.5, 0.5, 3), (2.0, 1.25, 4)],  # 2·√(d/a) up to d = v²/a = 0.5, then d/v + v/a
    ids=["a triangle", "just a triangle", "a trapezoid"],
)
def test_a_straight_edge_is_as_fast_as_the_limits_allow(distance, seconds, samples):
    trajectory = time([[0.0], [distance]])
    assert trajectory.duration == pytest.approx(seconds, rel=2e-3)
    assert len(trajectory.times) == samples


@pytest.mark.parametrize("distance", [0.08, 0.5, 2.0])
def test_waypoints_on_a_straight_edge_cost_next_to_nothing(distance):
    many = time(np.linspace(0.0, distance, 11)[:, None])
    assert len(stops(many)) == 2
    assert many.duration == pytest.approx(time([[0.0], [distance]]).duration, rel=0.03)


def test_the_joint_with_the_longest_way_for_its_limits_sets_the_pace():
    alone = time([[0.0], [1.0]])
    assert time([[0.0, 0.0, 0.0], [0.5, 1.0, -0.2]]).times == alone.times


def test_the_robot_stops_at_a_corner():
    corner = [[0.0, 0.0], [1.0, 0.0], [1.0, 1.0]]
    trajectory = time(corner)
    assert stops(trajectory) == list(map(tuple, corner))
    assert trajectory.duration == pytest.approx(2 * time(corner[:2]).duration)


def test_the_robot_turns_around():
    there_and_back = [[0.0, 0.0], [1.0, 0.5], [0.0, 0.0]]
    assert stops(time(there_and_back)) == list(map(tuple, there_and_back))


def test_the_robot_does_not_stop_on_a_curve():
    trajectory = time(np.column_stack([np.cos(ARC), np.sin(ARC)]) * 0.3)
    assert len(stops(trajectory)) == 2
    # 0.45 m of an arc with a radius of 0.3 m; across, v²/r stays below the limit up to 1.55 m/s
    assert trajectory.duration < 0.5


def test_a_joint_that_turns_round_between_two_waypoints_does_so_within_them():
    there_and_back = ARC + 0.796
    trajectory = time(np.column_stack([np.cos(there_and_back), np.sin(there_and_back)]) * 0.3)
    assert len(stops(trajectory)) == 2
    positions = trajectory.sample(np.linspace(0.0, trajectory.duration, 2001))[0]
    assert positions[:, 1].max() <= 0.3 * np.sin(there_and_back).max() + 1e-12


def test_a_joint_that_comes_to_rest_at_its_limit_does_not_swing_beyond_it():
    """The seventh joint of an arm that comes down on a block, to the end of its travel; the others go on."""
    turning = [3.0529, 3.0535, *[3.0543] * 9]
    trajectory = time(np.column_stack([turning, np.linspace(0.0, 0.2, 11)]))
    positions = trajectory.sample(np.linspace(0.0, trajectory.duration, 2001))[0]
    assert positions[:, 0].max() <= 3.0543 + 1e-12
    assert len(stops(trajectory)) == 2


def test_a_bend_too_wide_to_round_is_a_corner():
    bend = [[0.0, 0.0], [1.0, 0.0], [2.0, 0.15]]  # 9 degrees, but a curve would be far from such long edges
    assert stops(time(bend)) == list(map(tuple, bend))


def test_one_waypoint_is_a_standstill():
    assert time([[0.3, -1.0]]) == Trajectory((0.0,), ((0.3, -1.0),), ((0.0, 0.0),))
    assert time([[0.3, -1.0]] * 3) == time([[0.3, -1.0]])


def test_waypoints_that_repeat_are_passed_once():
    line = np.linspace(0.0, 0.3, 7)[:, None]
    assert time(np.repeat(line, 3, axis=0)) == time(line)


def test_the_shortest_motion_takes_two_cycles_of_a_controller():
    assert time([[0.0], [1e-12]]).duration == pytest.approx(0.002)


def test_what_is_written_down_is_sparse():
    line = np.linspace(0.0, 0.3, 11)[:, None] * np.ones(7)
    assert len(time(line).times) == 11
