"""What is said to be cut off is cut off: no planner finds a way there."""

from __future__ import annotations

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from plane_world import RADIUS

from llm3.interfaces import PlannerSettings
from llm3.types import Goal, MotionProblem, Path
from llm3_birrt.planner import BiRRT
from llm3_tabletop2d.bodies import Body, Separation
from llm3_tabletop2d.reach import cut_off
from llm3_tabletop2d.ways import CLEARANCE, is_free

LOW, HIGH = np.full(2, RADIUS), np.array((1.0, 0.6)) - RADIUS
START, GOAL = np.array((0.06, 0.3)), np.array((0.94, 0.3))
ROBOT = (Body("robot", (0.0, 0.0), radius=RADIUS),)
walls = st.lists(
    st.builds(
        lambda x, y, a, b, t: Body("wall", (x, y), (a, b), t),
        st.floats(0.2, 0.8),
        st.floats(0.0, 0.6),
        st.floats(0.01, 0.4),
        st.floats(0.01, 0.4),
        st.floats(0, 3),
    ),
    max_size=6,
)


def found(separation: Separation) -> bool:
    problem = MotionProblem(START, (Goal(tuple(GOAL)),), LOW, HIGH, lambda Q: is_free(separation, Q), 0.008)
    return isinstance(BiRRT(PlannerSettings(max_iterations=400)).plan(problem, np.random.default_rng(0)), Path)


@settings(max_examples=60, deadline=None)
@given(walls)
def test_no_way_is_found_where_none_is_said_to_be(standing):
    separation = Separation(ROBOT, standing)
    if not is_free(separation, np.array([START, GOAL])).all():
        return
    if cut_off(separation, LOW, HIGH, START, GOAL, ()) is not None:
        assert not found(separation)


@pytest.mark.parametrize("short", [0.0, 0.0001, 0.02])
def test_a_door_in_a_wall_is_judged_exactly(short):
    width = 2 * (RADIUS + CLEARANCE) - short
    standing = [Body("lower", (0.5, 0.0), (0.04, 0.4)), Body("upper", (0.5, 0.5 + width), (0.04, 0.6))]
    verdict = cut_off(Separation(ROBOT, standing), LOW, HIGH, START, GOAL, ())
    assert verdict == (() if short else None)


def test_what_can_be_moved_is_to_blame_where_it_alone_blocks():
    standing = [
        Body("lower", (0.5, 0.0), (0.04, 0.4)),
        Body("upper", (0.5, 0.6), (0.04, 0.4)),
        Body("plug", (0.5, 0.3), radius=0.08),
        Body("loose", (0.7, 0.3), radius=0.05),
    ]
    assert cut_off(Separation(ROBOT, standing), LOW, HIGH, START, GOAL, ("loose", "plug")) == ("plug",)
    standing[3] = Body("loose", (0.65, 0.3), (0.04, 1.0))
    assert cut_off(Separation(ROBOT, standing), LOW, HIGH, START, GOAL, ("loose", "plug")) == ()
