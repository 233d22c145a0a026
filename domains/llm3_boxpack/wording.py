"""What a model is told of the task and the world."""

from __future__ import annotations

from llm3.types import Entity, State
from llm3_boxpack.instance import TRAY_THICKNESS, BoxpackInstance
from llm3_bullet.robot import Gripper
from llm3_bullet.tabletop.wording import box_entity, gripper_text


def task_text(gripper: Gripper, wall_height: float) -> str:
    """The task in prose; lengths are those of the robot and the options in use."""
    walls = f" It has walls {wall_height:g} m high." if wall_height else " It has no walls."
    return (
        "A robot arm packs boxes into a basket on a table. The arm stands at (0, 0) and faces the positive x axis; "
        "y points to its left and z points up. The table's surface is at z = 0. Lengths are in metres, angles in "
        "radians.\n"
        f"The basket is a flat tray whose sides are parallel to x and y.{walls}\n"
        "The goal: every box lies in the basket with its whole footprint, and the gripper is empty. Boxes must not "
        "be put on top of one another.\n"
        f"{gripper_text(gripper)}"
    )


def describe(instance: BoxpackInstance, state: State) -> tuple[Entity, ...]:
    """The basket and the boxes, to the millimetre."""
    basket = instance.basket
    (x, y), (dx, dy) = basket.center, basket.size
    tray = Entity(
        "basket",
        {
            "center": (x, y),
            "x range": (round(x - dx / 2, 3), round(x + dx / 2, 3)),
            "y range": (round(y - dy / 2, 3), round(y + dy / 2, 3)),
            "floor height": TRAY_THICKNESS,
        },
    )
    boxes = (box_entity(box.name, box.size, state.poses.get(box.name)) for box in instance.boxes)
    return (tray, *boxes)
