"""What holds of every trajectory, whatever the path and the limits."""

from __future__ import annotations

from itertools import pairwise

import numpy as np
from hypothesis import assume, given, settings
from hypothesis import strategies as st

from llm3.types import Trajectory, Vector
from llm3_time.curved import TOLERANCE
from llm3_time.timer import ToppraTimer

QUICK = settings(max_examples=25)
Case = tuple[Vector, Vector, Vector]
"""Waypoints, and the limits of velocity and acceleration."""


def zigzag(rng: np.random.Generator, dof: int, count: int) -> Vector:
    """Waypoints anywhere, as a sampling planner's are; some repeat, some are very near."""
    waypoints = np.cumsum(rng.normal(size=(count, dof)) * 10.0 ** rng.uniform(-6, 0, size=(count, 1)), axis=0)
    return np.repeat(waypoints, rng.integers(1, 3, size=count), axis=0)


def curve(rng: np.random.Generator, dof: int, count: int) -> Vector:
    """Waypoints close to one another on a smooth curve, rounded as a domain's are."""
    t = np.linspace(0.0, rng.uniform(0.1, 1.0), count)[:, None]
    sines = rng.normal(size=dof) * np.sin(rng.uniform(0.5, 2.0, size=dof) * t + rng.uniform(0, 6, size=dof))
    return np.round(sines, 4)


def case_of(shape, dof: int, count: int, seed: int) -> Case:
    rng = np.random.default_rng(seed)
    velocity, acceleration = 10.0 ** rng.uniform(-1, 1, size=dof), 10.0 ** rng.uniform(-1, 2, size=dof)
    return shape(rng, dof, count), velocity, acceleration


cases = st.builds(
    case_of, st.sampled_from([zigzag, curve]), st.integers(1, 8), st.integers(1, 14), st.integers(0, 2**32 - 1)
)


def time(case: Case) -> Trajectory:
    return ToppraTimer().time(*case)


def dense(trajectory: Trajectory) -> Vector:
    """Times at which to look, some on the knots and the others close together."""
    between = [np.linspace(a, b, 13) for a, b in pairwise(trajectory.times)]
    return np.unique(np.concatenate([np.zeros(1), *between]))


def distances(points: Vector, start: Vector, end: Vector) -> Vector:
    """Of points (N, dof) from the line between two others."""
    way = end - start
    fraction = np.clip((points - start) @ way / max(way @ way, 1e-300), 0.0, 1.0)
    return np.linalg.norm(points - start - fraction[:, None] * way, axis=1)


@given(cases)
@QUICK
def test_it_passes_through_every_waypoint_in_order(case) -> None:
    positions = iter(time(case).positions)
    for waypoint in dict.fromkeys(map(tuple, case[0].tolist())):
        assert waypoint in positions  # what was looked at is gone from the iterator


@given(cases)
@QUICK
def test_it_begins_and_ends_with_the_path_at_a_standstill(case) -> None:
    trajectory = time(case)
    assert trajectory.positions[0] == tuple(case[0][0])
    assert trajectory.positions[-1] == tuple(case[0][-1])
    assert not any(trajectory.velocities[0])
    assert not any(trajectory.velocities[-1])


@given(cases)
@QUICK
def test_it_stays_near_the_edges_between_the_waypoints(case) -> None:
    waypoints, trajectory = case[0], time(case)
    points = trajectory.sample(dense(trajectory))[0]
    edges = [distances(points, a, b) for a, b in pairwise(waypoints)] or [distances(points, *waypoints[[0, 0]])]
    assert np.min(edges, axis=0).max() <= TOLERANCE * 1.01


@given(cases)
@QUICK
def test_no_joint_leaves_the_range_of_its_waypoints(case) -> None:
    """What a robot's own limits are, a timer does not know: the path was checked against them."""
    waypoints, trajectory = case[0], time(case)
    points = trajectory.sample(dense(trajectory))[0]
    blur = 1e-9 + 8 * np.finfo(float).eps * np.abs(waypoints).max()
    assert (points >= waypoints.min(axis=0) - blur).all()
    assert (points <= waypoints.max(axis=0) + blur).all()


@given(cases)
@QUICK
def test_velocities_and_accelerations_are_within_the_limits_at_all_times(case) -> None:
    _, max_velocity, max_acceleration = case
    trajectory = time(case)
    times = dense(trajectory)
    _, velocities, accelerations = trajectory.sample(times)
    assert (np.abs(velocities) <= max_velocity).all()
    assert (np.abs(accelerations) <= max_acceleration).all()


@given(cases)
@QUICK
def test_finite_differences_say_the_same(case) -> None:
    waypoints, max_velocity, max_acceleration = case
    trajectory = time(case)
    assume(trajectory.duration > 0)
    times = np.linspace(0.0, trajectory.duration, 1001)
    step = times[1]
    positions = trajectory.sample(times)[0]
    blur = 8 * np.finfo(float).eps * np.abs(waypoints).max()  # of a position, as a float
    assert (np.abs(np.diff(positions, axis=0)) <= max_velocity * step + blur).all()
    assert (np.abs(np.diff(positions, n=2, axis=0)) <= max_acceleration * step**2 + 2 * blur).all()


@given(cases)
@QUICK
def test_times_increase_from_zero(case) -> None:
    trajectory = time(case)
    assert trajectory.times[0] == 0.0
    assert all(a < b for a, b in pairwise(trajectory.times))
    assert trajectory.duration == trajectory.times[-1]


@given(cases)
@QUICK
def test_the_same_path_and_limits_give_the_same_trajectory(case) -> None:
    assert time(case) == time(tuple(values.copy() for values in case))


@given(cases, st.floats(0.1, 10.0))
@QUICK
def test_a_clock_that_is_slower_makes_no_other_motion(case, factor) -> None:
    waypoints, velocity, acceleration = case
    quick, slow = time(case), time((waypoints, velocity / factor, acceleration / factor**2))
    ramps = 2e-3 * (1 + 1 / factor) * len(waypoints)  # which are whole cycles of a controller at the least
    assert abs(slow.duration - factor * quick.duration) <= 1e-4 * slow.duration + factor * ramps


@given(cases, st.floats(1.0, 10.0), st.floats(1.0, 10.0))
@QUICK
def test_lower_limits_are_never_faster(case, velocity_factor, acceleration_factor) -> None:
    waypoints, velocity, acceleration = case
    slow = time((waypoints, velocity / velocity_factor, acceleration / acceleration_factor))
    # What is slowed down as a whole, or stops where the other does not, leaves a few per cent to chance.
    assert slow.duration >= 0.9 * time(case).duration


@given(cases)
@QUICK
def test_an_even_pace_with_a_stop_at_every_waypoint_is_never_faster(case) -> None:
    waypoints, velocity, acceleration = case
    edges = [time((waypoints[[i, i + 1]], velocity, acceleration)).duration for i in range(len(waypoints) - 1)]
    assert time(case).duration <= 1.05 * sum(edges) + 1e-9
