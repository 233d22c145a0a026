"""What is told of an execution, and the figures that a noise may have."""

from __future__ import annotations

import math

import pytest
from hypothesis import given
from hypothesis import strategies as st

from llm3.jsonio import dumps, loads
from llm3.types import (
    Action,
    Executed,
    Execution,
    ExecutionReport,
    GoalStatus,
    Noise,
    Pose,
    PoseError,
    Slip,
    State,
)

DEVIATIONS = st.floats(0.0, 1.0)


@pytest.mark.parametrize("name", ["position", "angle", "joints"])
@pytest.mark.parametrize("value", [-0.001, math.nan, math.inf])
def test_a_noise_is_a_standard_deviation(name, value):
    with pytest.raises(
        ValueError, match=rf"^the {name} noise must be a standard deviation of 0 or more, not {value:g}$"
    ):
        Noise(**{name: value})


@given(DEVIATIONS, DEVIATIONS, DEVIATIONS)
def test_there_is_noise_if_any_of_it_is_there(position, angle, joints):
    assert bool(Noise(position, angle, joints)) == (max(position, angle, joints) > 0)


def test_a_report_is_the_same_after_it_was_written_and_read():
    slip = Slip("cup slipped by 3.1 mm and 0.0 degrees in the gripper", {"position": 0.0031, "angle": 0.0})
    done = Executed(Action("pick", ("cup",)), 2.5, 0.01, 0.002, None, (slip,))
    state = State({"cup": Pose((0.1, 0.2, 0.3))}, (0.5,))
    report = ExecutionReport(
        Execution(state, state, (done,)), GoalStatus(False, ("cup is not there",)), {"cup": PoseError(0.1, 0.2)}
    )
    assert loads(dumps(report), ExecutionReport, "the report") == report
    assert str(slip) == slip.sentence
