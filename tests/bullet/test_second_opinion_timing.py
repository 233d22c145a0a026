"""The second opinion on trajectories: they keep the limits, begin and end at rest, and are looked at all along."""

from __future__ import annotations

import re
from dataclasses import replace

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from shelf_world import (
    CARRIED,
    DROP,
    END,
    LEAVE,
    LEAVING,
    SHELF,
    TAKE,
    at,
    found,
    lines,
    moved_by,
)

from llm3.types import Pose, Trajectory
from llm3_bullet.scene import Box
from llm3_bullet.verification.sweep import cubic

STILL = (0.0, 0.0, 0.0)
WAY = END - CARRIED


@pytest.fixture(scope="module")
def robot(descriptions):
    return replace(descriptions["toy"], max_acceleration={"slide": 2.0})


def timed(seconds, **changes):
    """The second action, whose segment takes so long: one cubic polynomial from rest to rest."""
    trajectory = Trajectory((0.0, seconds), (at(CARRIED), at(END)), (STILL, STILL))
    return moved_by(DROP, replace(LEAVE, trajectory=replace(trajectory, **changes)))


def test_a_slow_one_is_sound(robot):
    assert found(robot, timed(1.0)) == []


def test_one_without_any_way_is_sound(robot):
    rest = moved_by(
        DROP, replace(LEAVE, waypoints=(at(CARRIED),), trajectory=Trajectory((0.0,), (at(CARRIED),), (STILL,)))
    )
    assert found(robot, replace(rest, state=replace(DROP.state, configuration=at(CARRIED)))) == []


def test_too_fast_and_too_hard(robot):
    """From rest to rest a cubic reaches 1.5 times the mean speed in the middle, and accelerates hardest at its ends."""
    assert found(robot, timed(0.1)) == [
        f"{LEAVING}, 0.050 s: slide moves at {1.5 * WAY / 0.1:.4f} m/s, and its limit is 1.0000 m/s",
        f"{LEAVING}, 0.000 s: slide accelerates by {6 * WAY / 0.01:.4f} m/s², and its limit is 2.0000 m/s²",
    ]


def test_at_its_limits_it_is_sound(robot):
    assert found(robot, timed((6 * WAY / 2.0) ** 0.5)) == []


def test_without_a_known_limit_none_is_held(descriptions):
    assert found(descriptions["toy"], timed(0.2)) == []


def test_one_that_begins_or_ends_elsewhere(robot):
    assert found(robot, timed(1.0, positions=(at(CARRIED + 0.01), at(END - 0.01)))) == [
        f"{LEAVING}, 0.000 s: the trajectory begins with slide at 0.0400 m, and the waypoints at 0.0300 m",
        f"{LEAVING}, 1.000 s: the trajectory ends with slide at 0.0900 m, and the waypoints at 0.1000 m",
    ]


def test_one_that_does_not_begin_or_end_at_rest(robot):
    assert found(robot, timed(1.0, velocities=((0.1, 0.0, 0.0), (0.0, 0.02, 0.0)))) == [
        f"{LEAVING}, 0.000 s: the trajectory begins while slide moves at 0.1000 m/s",
        f"{LEAVING}, 1.000 s: the trajectory ends while shoulder moves at 0.0200 rad/s",
        f"{LEAVING}, 0.625 s: the trajectory is off the straight way from waypoint 0 to 1: shoulder by 0.0029 rad",
    ]


def test_one_that_swings_beyond_the_limits_between_its_times(descriptions):
    """At its times it is within them, and so are the waypoints."""
    out = Trajectory((0.0, 1.0, 2.0), (at(CARRIED), at(0.49), at(END)), (STILL, (0.3, 0.0, 0.0), STILL))
    assert found(descriptions["toy"], moved_by(DROP, replace(LEAVE, trajectory=out))) == [
        f"{LEAVING}, 1.125 s: the trajectory is off the straight way from waypoint 0 to 1: slide by 0.4020 m",
        f"{LEAVING}, 1.093 s: slide is at 0.5035 m, and its limits are -0.3000 and 0.5000 m",
    ]


def test_one_that_passes_by_a_waypoint(robot):
    bent = replace(timed(1.0).motion.segments[0], waypoints=(at(CARRIED), (0.05, 0.01, 0.0), at(END)))
    assert found(robot, moved_by(DROP, bent)) == [
        f"{LEAVING}, waypoint 1.00: the trajectory does not pass through the waypoint"
    ]


def test_one_that_goes_through_the_waypoints_and_astray_between_them(robot):
    """From rest to rest in the slide, and at 0.01 rad/s in the shoulder at half time: it sways by 1/27 of a rad/s·s."""
    sway = Trajectory((0.0, 1.0, 2.0), (at(CARRIED), at(0.065), at(END)), (STILL, (0.05, 0.01, 0.0), STILL))
    assert found(robot, moved_by(DROP, replace(LEAVE, trajectory=sway))) == [
        f"{LEAVING}, 0.625 s: the trajectory is off the straight way from waypoint 0 to 1: shoulder by 0.0015 rad"
    ]


def test_one_that_is_in_no_hurry_between_waypoints_is_sound(robot):
    """The same waypoint twice, and a halt between two."""
    stops = (at(CARRIED), at(0.05), at(0.05), at(END))
    halting = Trajectory((0.0, 1.0, 1.5, 2.0, 3.0), (stops[0], at(0.04), at(0.04), *stops[2:]), (STILL,) * 5)
    assert found(robot, moved_by(DROP, replace(LEAVE, waypoints=stops, trajectory=halting))) == []


def test_one_that_leaves_the_way_for_an_obstacle(robot):
    """It leans by 0.2 rad between its times, and has come back at them."""
    post = Box("post", (0.01, 0.2, 0.01), Pose((-0.06, 0.1, 0.9)), fixed=True)
    sideways = (0.0, -1.6, 0.0)
    lean = Trajectory((0.0, 1.0, 2.0), (at(CARRIED), at(0.05), at(END)), (STILL, sideways, STILL))
    told = lines(robot, (TAKE, moved_by(DROP, replace(LEAVE, trajectory=lean))), fixed=(SHELF, post))
    touches = [line for line in told if "post" in line]
    assert touches
    for line in touches:
        assert re.fullmatch(re.escape(LEAVING) + r", 1\.\d{3} s: \w+ touches post, \d+\.\d\d mm deep", line)


# ---- the polynomials -------------------------------------------------------------------------------------------------

numbers = st.lists(st.floats(-2.0, 2.0), min_size=3, max_size=3).map(np.array)


@given(numbers, numbers, numbers, numbers)
def test_a_cubic_has_the_positions_and_derivatives_of_its_ends(a, b, va, vb):
    piece, h = cubic(a, b, va, vb), 1e-6
    np.testing.assert_allclose(piece.at(0.0), a, atol=1e-9)
    np.testing.assert_allclose(piece.at(1.0), b, atol=1e-9)
    np.testing.assert_allclose((piece.at(h) - a) / h, va, atol=1e-3)
    np.testing.assert_allclose((b - piece.at(1 - h)) / h, vb, atol=1e-3)


@given(numbers, numbers, numbers, numbers)
def test_the_bend_of_a_cubic_bounds_what_a_lever_of_a_metre_does(a, b, va, vb):
    """The end of a planar chain of a metre, whose joints sit in one place: its angle is the sum of the joint values."""
    piece = cubic(a, b, va, vb)
    u = np.linspace(0.0, 1.0, 401)
    angles = np.array([piece.at(float(x)).sum() for x in u])
    path = np.column_stack([np.cos(angles), np.sin(angles)])
    second = np.diff(path, 2, axis=0) / (u[1] - u[0]) ** 2
    assert np.linalg.norm(second, axis=1).max() <= piece.bend + 1e-6
