"""Nothing is handed over that the robot cannot follow, however a controller fills in between the points."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest
from hypothesis import assume, given, settings
from hypothesis import strategies as st
from programs import trajectories

from llm3.errors import LLM3Error
from llm3.export import Move, Program, check_program
from llm3.export.curves import accelerations, cubics, extreme, largest, quintics
from llm3.interfaces import Joint
from llm3.types import Trajectory

WHEEL = Joint("wheel", "m", max_velocity=1.0, max_acceleration=2.0, min_position=-1.0, max_position=1.0)
ARM = Joint("arm", "rad", max_velocity=5.0, max_acceleration=50.0)
WAY = Trajectory((0.0, 0.5, 1.0), ((0.0, 0.0), (0.25, 0.1), (0.5, 0.2)), ((0.0, 0.0), (0.75, 0.3), (0.0, 0.0)))


def check(trajectory: Trajectory, joint: Joint = WHEEL, start=(0.0, 0.0), quintic: bool = False) -> None:
    program = Program(("wheel", "arm"), ("m", "rad"), (Move(3, "go([], {})", "transit", trajectory),))
    check_program(program, (joint, ARM), start, quintic)


def complaint(trajectory: Trajectory, joint: Joint = WHEEL, start=(0.0, 0.0), quintic: bool = False) -> str:
    with pytest.raises(LLM3Error) as error:
        check(trajectory, joint, start, quintic)
    return str(error.value)


def scaled(factor: float) -> Trajectory:
    """The same way, as many times as far."""
    rows = ([tuple(factor * x for x in row) for row in rows] for rows in (WAY.positions, WAY.velocities))
    return Trajectory(WAY.times, *map(tuple, rows))


def test_a_motion_at_just_its_limits_passes():
    check(WAY, replace(WHEEL, max_velocity=0.75, max_acceleration=3.0, max_position=0.5))
    check(WAY, Joint("wheel", "m"))  # of which nothing is known


@pytest.mark.parametrize(
    ("trajectory", "joint", "start", "sentence"),
    [
        (WAY, WHEEL, (0.0, 0.0), "0.000 s: wheel accelerates by 3.0000 m/s², and its limit is 2.0000 m/s²."),
        (
            WAY,
            replace(WHEEL, max_velocity=0.7, max_acceleration=None),
            (0.0, 0.0),
            "0.500 s: wheel moves at 0.7500 m/s, and its limit is 0.7000 m/s.",
        ),
        (scaled(3), WHEEL, (0.0, 0.0), "1.000 s: wheel is at 1.5000 m, and its limits are -1.0 and 1.0 m."),
        (scaled(-3), WHEEL, (0.0, 0.0), "1.000 s: wheel is at -1.5000 m, and its limits are -1.0 and 1.0 m."),
        (WAY, WHEEL, (0.0, 0.01), "0.000 s: arm jumps by 0.0100 rad from where the robot is."),
        (
            replace(WAY, velocities=((0.1, 0.0), (0.75, 0.3), (0.0, 0.0))),
            WHEEL,
            (0.0, 0.0),
            "0.000 s: the trajectory begins while wheel moves at 0.1000 m/s.",
        ),
        (
            replace(WAY, velocities=((0.0, 0.0), (0.75, 0.3), (0.0, -0.1))),
            WHEEL,
            (0.0, 0.0),
            "1.000 s: the trajectory ends while arm moves at 0.1000 rad/s.",
        ),
        (
            replace(WAY, velocities=((0.0, 0.0), (1e308, 0.3), (0.0, 0.0))),
            WHEEL,
            (0.0, 0.0),
            "0.333 s: wheel is at -7.407e+306 m, and its limits are -1.0 and 1.0 m.",
        ),
        (
            replace(WAY, times=(0.0, 50.0, 100.0), velocities=((0.0, 0.0), (1e308, 0.3), (0.0, 0.0))),
            WHEEL,
            (0.0, 0.0),
            "0.000 s: wheel is at inf m, and its limits are -1.0 and 1.0 m.",
        ),
    ],
)
def test_what_the_robot_cannot_do_is_told_with_its_place_and_figures(trajectory, joint, start, sentence):
    said = complaint(trajectory, joint, start)
    assert said.startswith("action 3 go([], {}), transit, ")
    assert said.removeprefix("action 3 go([], {}), transit, ") == sentence


def test_each_motion_begins_where_the_last_one_ended():
    program = Program(("wheel",), ("m",), tuple(Move(n, "go", "way", still(x)) for n, x in ((1, 0.0), (2, 0.5))))
    with pytest.raises(LLM3Error) as error:
        check_program(program, (WHEEL,), (0.0,))
    assert str(error.value) == "action 2 go, way, 0.000 s: wheel jumps by 0.5000 m from where the robot is."


def still(x: float) -> Trajectory:
    return Trajectory((0.0,), ((x,),), ((0.0,),))


def test_a_controller_that_gets_accelerations_would_leave_limits_that_the_cubics_keep():
    fast = replace(WAY, velocities=((0.0, 0.0), (1.0, 0.4), (0.0, 0.0)))
    check(fast)
    assert complaint(fast, quintic=True) == (
        "action 3 go([], {}), transit, 0.322 s: wheel accelerates by 2.7479 m/s² where accelerations are followed, "
        "and its limit is 2.0000 m/s²."
    )


@given(trajectories(2))
@settings(deadline=None, max_examples=50)
def test_the_cubics_are_those_of_the_trajectory(trajectory):
    assume(len(trajectory.times) > 1)
    fractions = np.linspace(0, 1, 9)
    seen = cubics(trajectory).positions(fractions)
    times = np.array(trajectory.times)
    between = times[:-1] + fractions[:, None] * np.diff(times)
    expected = trajectory.sample(between.ravel())[0].reshape(seen.shape)
    size = max(1.0, np.abs(trajectory.positions).max(), np.abs(trajectory.velocities).max() * np.diff(times).max())
    np.testing.assert_allclose(seen, expected, atol=1e-9 * size)


@given(trajectories(1))
@settings(deadline=None, max_examples=50)
def test_a_quintic_has_positions_velocities_and_accelerations_of_both_its_ends(trajectory):
    assume(len(trajectory.times) > 1)
    ends = [np.array(rows) for rows in (trajectory.positions, trajectory.velocities)] + [accelerations(trajectory)]
    size = max(np.abs(rows).max() for rows in ends) + np.abs(quintics(trajectory).derivatives[2]).max() + 1
    for coefficients, rows in zip(quintics(trajectory).derivatives, ends, strict=True):
        np.testing.assert_allclose(coefficients[0], rows[:-1], atol=1e-9 * size)
        np.testing.assert_allclose(coefficients.sum(axis=0), rows[1:], atol=1e-6 * size)


@given(st.lists(st.floats(-10, 10), min_size=2, max_size=6), st.floats(0, 20))
@settings(deadline=None, max_examples=80)
def test_what_is_called_the_largest_is_never_exceeded_and_reached_where_it_matters(coefficients, worth):
    c = np.array(coefficients)
    seen = np.abs(np.polyval(c[::-1], np.linspace(0, 1, 401))).max()
    (found,) = largest(c[:, None, None], np.array([worth])).ravel()
    assert found >= seen - 1e-9
    where, value = extreme(c)
    assert 0 <= where <= 1
    assert abs(value) == pytest.approx(seen, abs=1e-2)
    assert found == abs(value) or found <= worth


@pytest.mark.parametrize("ends", [(None, 1.0), (1.0, None), (1.0, 1.0), (0.0, float("inf"))])
def test_the_ends_of_a_joints_travel_are_two_numbers_or_none(ends):
    with pytest.raises(ValueError) as error:
        Joint("wheel", "m", min_position=ends[0], max_position=ends[1])
    assert str(error.value) == (
        "joint 'wheel': the min position and the max position must be two numbers, the first one less, or both null, "
        f"not {ends[0]} and {ends[1]}"
    )
