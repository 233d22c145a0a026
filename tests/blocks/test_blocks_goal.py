from __future__ import annotations

from dataclasses import replace

import pytest
from block_world import moved, problem, tower
from hypothesis import given
from hypothesis import strategies as st

from llm3.types import Held, Pose, State
from llm3_blocks.goal import goal_status

PROBLEM = problem(
    tower("red_block", at=(0.45, 0.1)),
    tower("blue_block", at=(0.45, -0.1)),
    tower("tan_block", at=(0.5, 0.0)),
    goal="red_block on blue_block, blue_block on table",
)
DONE = State(
    {
        "red_block": Pose((0.45, -0.1, 0.075)),
        "blue_block": Pose((0.45, -0.1, 0.025)),
        "tan_block": Pose((0.5, 0.0, 0.025)),
    }
)


def unmet(state: State) -> tuple[str, ...]:
    return goal_status(PROBLEM, state).unmet


def test_it_is_reached_where_every_block_rests_on_what_it_belongs_on():
    assert goal_status(PROBLEM, DONE).achieved


@given(st.floats(-0.024, 0.024), st.floats(-0.024, 0.024))
def test_the_centre_over_the_lower_block_is_enough(dx, dy):
    assert unmet(moved(DONE, "red_block", 0.45 + dx, -0.1 + dy, 0.075)) == ()


@given(st.floats(0.0252, 0.049), st.booleans())
def test_a_centre_beside_it_is_not(by, along_x):
    dx, dy = (by, 0.0) if along_x else (0.0, by)
    assert unmet(moved(DONE, "red_block", 0.45 + dx, -0.1 + dy, 0.075)) == ("red_block is not on blue_block",)


@pytest.mark.parametrize("height", [0.025, 0.08, 0.125])
def test_hovering_over_it_or_lying_in_it_is_not_resting_on_it(height):
    assert unmet(moved(DONE, "red_block", 0.45, -0.1, height)) == ("red_block is not on blue_block",)


def test_a_block_on_another_one_is_not_on_the_table():
    lifted = moved(moved(DONE, "blue_block", 0.5, 0.0, 0.075), "red_block", 0.5, 0.0, 0.125)
    assert unmet(lifted) == ("blue_block is not on the table",)


def test_a_block_in_the_gripper_is_nowhere_and_nothing_is_on_it():
    held = Held("blue_block", Pose((0.0, 0.0, 0.0)))
    state = replace(DONE, poses={n: p for n, p in DONE.poses.items() if n != "blue_block"}, held=held)
    assert unmet(state) == (
        "red_block is not on blue_block",
        "blue_block is still in the gripper, and not on the table",
    )


def test_a_block_that_belongs_nowhere_has_to_be_put_down_all_the_same():
    held = Held("tan_block", Pose((0.0, 0.0, 0.0)))
    state = replace(DONE, poses={n: p for n, p in DONE.poses.items() if n != "tan_block"}, held=held)
    assert unmet(state) == ("tan_block is still in the gripper",)
