"""When the towers stand."""

from __future__ import annotations

from collections.abc import Mapping

from llm3.types import GoalStatus, State
from llm3_blocks.instance import BlocksInstance, On
from llm3_bullet.scene import Size
from llm3_bullet.tabletop.resting import is_over, rests_on, rests_on_table
from llm3_bullet.tabletop.table import TABLE


def goal_status(instance: BlocksInstance, state: State) -> GoalStatus:
    """Every block of the goal rests where it belongs with its centre over what is below, and none is held."""
    sizes = instance.sizes
    unmet = [_unmet(on, state) for on in instance.goal if not _holds(on, state, sizes)]
    held = state.held.object if state.held else None
    if held and held not in (on.block for on in instance.goal):
        unmet.append(f"{held} is still in the gripper")
    return GoalStatus(not unmet, tuple(unmet))


def _holds(on: On, state: State, sizes: Mapping[str, Size]) -> bool:
    if on.block not in state.poses:
        return False
    pose, size = state.poses[on.block], sizes[on.block]
    if on.below == TABLE:
        return rests_on_table(pose, size)
    if on.below not in state.poses:
        return False
    below, size_below = state.poses[on.below], sizes[on.below]
    return rests_on(pose, size, below, size_below) and is_over(pose, below, size_below)


def _unmet(on: On, state: State) -> str:
    below = "the table" if on.below == TABLE else on.below
    if on.block not in state.poses:
        return f"{on.block} is still in the gripper, and not on {below}"
    return f"{on.block} is not on {below}"
