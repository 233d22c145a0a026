"""Evenly spaced points: the same way, within the limits for whoever follows cubics or quintics."""

from __future__ import annotations

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from llm3.errors import UsageError
from llm3.export import Deed, Move, Program, check_program, resampled
from llm3.export.curves import cubics, quintics
from llm3.interfaces import Joint
from llm3.types import Event, EventKind, Trajectory
from llm3_time.piece import Limits
from llm3_time.straight import straight

JOINTS = (Joint("x", "m", 1.0, 4.0), Joint("y", "rad", 2.0, 10.0))
LIMITS = Limits(np.array([1.0, 2.0]), np.array([4.0, 10.0]))


def program_to(*corners: tuple[float, float]) -> Program:
    """As fast as can be along straight lines from the origin, with a stop at each corner."""
    times, positions, velocities = [0.0], [(0.0, 0.0)], [(0.0, 0.0)]
    for corner in corners:
        piece = straight(np.array(positions[-1]), np.array(corner), LIMITS)
        times += (piece.times[1:] + times[-1]).tolist()
        positions += map(tuple, piece.positions[1:].tolist())
        velocities += map(tuple, piece.velocities[1:].tolist())
    way = Trajectory(tuple(times), tuple(positions), tuple(velocities))
    items = (Deed(1, "go", Event(EventKind.GRIPPER, 0.1)), Move(1, "go", "way", way))
    return Program(("x", "y"), ("m", "rad"), items)


COORDINATES = st.floats(-2.0, 2.0).filter(lambda x: abs(x) > 0.01)
CORNERS = st.lists(st.tuples(COORDINATES, COORDINATES), min_size=1, max_size=3, unique_by=lambda c: round(c[0], 2))


@given(CORNERS, st.floats(60.0, 300.0))
@settings(deadline=None, max_examples=10)
def test_a_resampled_motion_keeps_limits_and_way_and_is_even(corners, rate):
    program = program_to(*corners)
    check_program(program, JOINTS, (0.0, 0.0))
    even = resampled(program, rate, JOINTS)
    check_program(even, JOINTS, (0.0, 0.0), quintic=True)
    (deed, move), (_, planned) = even.items, program.items
    assert deed == program.items[0]
    points = move.trajectory
    np.testing.assert_allclose(np.diff(points.times), 1 / rate, atol=2e-9)
    for end in (0, -1):
        assert points.positions[end] == planned.trajectory.positions[end]
    assert planned.trajectory.duration - 1e-6 <= points.duration <= 1.5 * planned.trajectory.duration + 3 / rate
    ends = np.array([(0.0, 0.0), *corners])
    fractions = np.array([0.0, 0.2, 0.8])
    for curves in (cubics(points), quintics(points)):
        for point in curves.positions(fractions).reshape(-1, 2):
            assert distance(point, ends) < 0.002


def distance(point, corners) -> float:
    a, way = corners[:-1], np.diff(corners, axis=0)
    along = np.clip(((point - a) * way).sum(axis=1) / (way**2).sum(axis=1), 0.0, 1.0)
    return float(np.linalg.norm(a + along[:, None] * way - point, axis=1).min())


def test_too_few_points_are_refused_as_they_would_cut_corners():
    with pytest.raises(UsageError) as error:
        resampled(program_to((0.5, 0.0), (0.5, 0.5)), 3.0, JOINTS)
    assert str(error.value) == (
        "3 points a second are too few: in action 1 go, way, x would be 0.0046 m off the way that was planned, and "
        "0.0005 m are allowed. Give a higher --rate, or none."
    )


def test_what_no_slowness_cures_ends_in_a_sentence():
    joints = (Joint("x", "m", 1.0, 4.0, -1.0, 0.4), JOINTS[1])
    with pytest.raises(UsageError) as error:
        resampled(program_to((0.5, 0.0)), 50.0, joints)
    assert str(error.value) == (
        "with 50 points a second, action 1 go, way, cannot keep the limits: give another --rate, or none."
    )


def test_a_motion_that_takes_no_time_stays_as_it_is():
    move = Move(1, "go", "way", Trajectory((0.0,), ((0.5, 0.0),), ((0.0, 0.0),)))
    program = Program(("x", "y"), ("m", "rad"), (move,))
    assert resampled(program, 100.0, JOINTS) == program
