"""The noun: what it refuses, and what lies between its times."""

from __future__ import annotations

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from scipy.interpolate import CubicHermiteSpline

from llm3.interfaces import Joint
from llm3.jsonio import dumps, loads
from llm3.types import Motion, Segment, Trajectory


def trajectory_of(dof: int, steps: list[float], seed: int) -> Trajectory:
    rng = np.random.default_rng(seed)
    times = np.cumsum([0.0, *steps])
    positions, velocities = rng.normal(size=(2, len(times), dof)).tolist()
    return Trajectory(tuple(times.tolist()), tuple(map(tuple, positions)), tuple(map(tuple, velocities)))


trajectories = st.builds(
    trajectory_of, st.integers(1, 7), st.lists(st.floats(0.01, 2.0), min_size=1, max_size=9), st.integers(0, 99)
)


@given(trajectories, st.integers(0, 99))
def test_between_its_times_it_is_the_cubic_hermite_interpolation(trajectory, seed):
    times = np.sort(np.random.default_rng(seed).uniform(0.0, trajectory.duration, 20))
    spline = CubicHermiteSpline(trajectory.times, trajectory.positions, trajectory.velocities)
    for derivative, found in enumerate(trajectory.sample(times)):
        assert np.allclose(found, spline(times, derivative), rtol=1e-6, atol=1e-6)


@given(trajectories)
def test_at_its_times_it_is_what_is_written(trajectory):
    positions, velocities, _ = trajectory.sample(trajectory.times)
    assert np.allclose(positions, trajectory.positions, rtol=0, atol=1e-9)
    assert np.allclose(velocities, trajectory.velocities, rtol=0, atol=1e-9)


@given(trajectories)
def test_before_and_after_it_the_robot_stands(trajectory):
    positions, velocities, accelerations = trajectory.sample([-1.0, trajectory.duration + 1.0])
    assert np.allclose(positions, np.array(trajectory.positions)[[0, -1]])
    assert not velocities.any()
    assert not accelerations.any()


def test_a_standstill_has_no_duration():
    still = Trajectory((0.0,), ((1.0, 2.0),), ((0.0, 0.0),))
    assert still.duration == 0.0
    positions, velocities, accelerations = still.sample([0.0, 1.0])
    assert positions.tolist() == [[1.0, 2.0]] * 2
    assert not velocities.any()
    assert not accelerations.any()


@given(trajectories)
def test_it_is_written_and_read_as_json(trajectory):
    assert loads(dumps(trajectory), Trajectory, "a plan") == trajectory


@pytest.mark.parametrize(
    ("times", "positions", "velocities", "sentence"),
    [
        ((), (), (), "a trajectory's times must begin with 0 and increase, and () do not"),
        ((1.0,), ((0,),), ((0,),), "a trajectory's times must begin with 0 and increase, and (1.0,) do not"),
        (
            (0.0, 1.0, 1.0),
            ((0,), (1,), (2,)),
            ((0,), (0,), (0,)),
            "a trajectory's times must begin with 0 and increase, and (0.0, 1.0, 1.0) do not",
        ),
        (
            (0.0, float("inf")),
            ((0,), (1,)),
            ((0,), (0,)),
            "a trajectory's times must be finite numbers, not (0.0, inf)",
        ),
        ((0.0, 1.0), ((0, 0),), ((0, 0),), "a trajectory's positions must be 2 numbers at each of its 2 times"),
        ((0.0,), ((0, 0),), ((0,),), "a trajectory's velocities must be 2 numbers at each of its 1 times"),
        (
            (0.0,),
            ((0.0,),),
            ((float("nan"),),),
            "a trajectory's velocities must be finite numbers, not (nan,)",
        ),
    ],
)
def test_what_makes_no_sense_is_refused(times, positions, velocities, sentence):
    with pytest.raises(ValueError) as caught:
        Trajectory(times, positions, velocities)
    assert str(caught.value) == sentence


def test_a_motion_takes_as_long_as_its_segments_if_all_have_times():
    def segment(seconds: float | None) -> Segment:
        trajectory = Trajectory((0.0, seconds), ((0.0,), (1.0,)), ((0.0,), (0.0,))) if seconds else None
        return Segment("transit", ((0.0,), (1.0,)), trajectory=trajectory)

    assert Motion((segment(1.0), segment(2.5))).duration == 3.5
    assert Motion((segment(1.0), segment(None))).duration is None
    assert Motion().duration == 0.0


@pytest.mark.parametrize("limit", [0.0, -1.0, float("inf"), float("nan")])
def test_a_joint_has_limits_that_can_be_kept(limit):
    for name, words in (("max_velocity", "max velocity"), ("max_acceleration", "max acceleration")):
        with pytest.raises(ValueError) as caught:
            Joint("wheel", **{name: limit})
        assert str(caught.value) == f"joint 'wheel': the {words} must be more than 0, not {limit:g}"
