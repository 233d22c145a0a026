"""When the robot is where, with and without times in the plan."""

from __future__ import annotations

import numpy as np
from hypothesis import given
from hypothesis import strategies as st
from hypothesis.extra.numpy import arrays

from llm3.types import PACE, Segment, Timed, Trajectory

WAYPOINTS = st.integers(1, 5).flatmap(lambda n: arrays(float, (n, 3), elements=st.floats(-3.0, 3.0)))
TRAJECTORY = Trajectory((0.0, 0.5, 2.0), ((0.0,), (0.3,), (1.0,)), ((0.0,), (0.4,), (0.0,)))


def untimed(waypoints) -> Timed:
    return Timed(Segment("go", tuple(map(tuple, waypoints.tolist()))))


@given(WAYPOINTS)
def test_without_times_it_begins_and_ends_at_the_ends_and_the_fastest_joint_keeps_the_pace(waypoints):
    timed = untimed(waypoints)
    assert np.allclose(timed.positions([0.0, timed.duration]), waypoints[[0, -1]])
    times = np.linspace(0.0, timed.duration, 50)
    speeds = np.abs(np.diff(timed.positions(times), axis=0)).max(axis=1)
    assert (speeds <= PACE * np.diff(times) + 1e-9).all()
    assert np.isclose(timed.duration, sum(np.abs(np.diff(waypoints, axis=0)).max(axis=1)) / PACE)


@given(st.floats(-1.0, 3.0))
def test_a_trajectory_is_followed(time):
    timed = Timed(Segment("go", ((0.0,), (1.0,)), trajectory=TRAJECTORY))
    assert timed.duration == TRAJECTORY.duration
    assert (timed.positions([time]) == TRAJECTORY.sample([time])[0]).all()
