"""What a model is told of the task and the world."""

from __future__ import annotations

from llm3.types import Entity, State
from llm3_blocks.instance import BlocksInstance
from llm3_bullet.robot import Gripper
from llm3_bullet.tabletop.resting import rests_on_table, support_of
from llm3_bullet.tabletop.table import TABLE
from llm3_bullet.tabletop.wording import box_entity, gripper_text, hand_text


def task_text(instance: BlocksInstance, gripper: Gripper) -> str:
    """The task in prose; lengths are those of the robot in use."""
    return (
        "A robot arm builds towers of blocks on a table. The arm stands at (0, 0) and faces the positive x axis; "
        "y points to its left and z points up. The table's surface is at z = 0. Lengths are in metres, angles in "
        "radians.\n"
        f"The goal: {', '.join(map(str, instance.goal))}, and the gripper is empty. Here on(a, b) means that block a "
        f"rests on block b, or on the {TABLE}, with its centre over what it rests on.\n"
        "A block on which another one stands cannot be picked, and nothing else can be stacked on it. A block is only "
        "placed on free space of the table. Keep the whole hand in mind: it is wider than a block, and low above the "
        "block that it holds, so a tower that is higher than this block must not be close beside it.\n"
        f"{gripper_text(gripper, 'block')}{_hand(instance, gripper)}"
    )


def _hand(instance: BlocksInstance, gripper: Gripper) -> str:
    """Where towers are close together, what decides is how large the hand is."""
    text = hand_text(gripper, "block") if instance.close else ""
    return text and f" {text}"


def describe(instance: BlocksInstance, state: State) -> tuple[Entity, ...]:
    """The blocks to the millimetre, each with what it stands on."""
    return tuple(_entity(instance, state, block.name) for block in instance.blocks)


def _entity(instance: BlocksInstance, state: State, name: str) -> Entity:
    sizes = instance.sizes
    if name not in state.poses:
        return box_entity(name, sizes[name], None)
    pose = state.poses[name]
    on_table = TABLE if rests_on_table(pose, sizes[name]) else "nothing squarely"
    support = support_of(name, state.poses, sizes) or on_table
    return box_entity(name, sizes[name], pose, **{"stands on": support})
