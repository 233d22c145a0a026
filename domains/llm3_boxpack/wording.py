"""What a model is told of the task and the world."""

from __future__ import annotations

from llm3.types import Entity, State
from llm3_boxpack.instance import TRAY_THICKNESS, WALLS, BoxpackInstance, BoxSpec
from llm3_bullet.robot import Gripper, ParallelGripper, RobotDescription
from llm3_bullet.tabletop.grasps import OPENING_MARGIN, hand_heights
from llm3_bullet.tabletop.wording import box_entity, gripper_text


def task_text(instance: BoxpackInstance, robot: RobotDescription) -> str:
    """The task in prose; lengths are those of the robot and the problem in use."""
    height = instance.basket.walls
    walls = f" It has walls {height:g} m high: {', '.join(WALLS)}." if height else " It has no walls."
    others = " What is not to be packed may end anywhere." if instance.clutter else ""
    return (
        "A robot arm packs boxes into a basket on a table. The arm stands at (0, 0) and faces the positive x axis; "
        "y points to its left and z points up. The table's surface is at z = 0. Lengths are in metres, angles in "
        "radians.\n"
        f"The basket is a flat tray whose sides are parallel to x and y.{walls}\n"
        "The goal: every box lies in the basket with its whole footprint, and the gripper is empty. Boxes must not "
        f"be put on top of one another.{others}\n"
        f"{gripper_text(robot.gripper)}{_heights_text(instance, robot)}"
    )


def _heights_text(instance: BoxpackInstance, robot: RobotDescription) -> str:
    """What the hand passes over, and how far the arm reaches, where it matters and is known."""
    if not _tells_heights(instance, robot.gripper):
        return ""
    reach = (
        " Of the arm is told how far from (0, 0) the middle of a box can be, at least and at most, so that the arm "
        "surely reaches it, however it is turned."
    )
    return (
        "\nThe hand passes over what is lower than it. Of each box is told how high the fingertips and the palm are "
        "above what it stands on when the gripper takes it or lets go of it. What is higher than the fingertips must "
        "not be where a finger is: beside the middle of each of the two faces. What is higher than the palm must not "
        "be below it: its middle is above that of the box, and it is longest from finger to finger."
        f"{reach if robot.reach_from_above else ''}"
    )


def _tells_heights(instance: BoxpackInstance, gripper: Gripper) -> bool:
    known = isinstance(gripper, ParallelGripper) and gripper.finger_width and gripper.palm_size
    return bool(known and (instance.basket.walls or instance.clutter))


def describe(instance: BoxpackInstance, robot: RobotDescription, state: State) -> tuple[Entity, ...]:
    """The basket, the boxes and what is in the way, to the millimetre; and hand and arm, where heights matter."""
    gripper = robot.gripper
    things = tuple(_entity(instance, gripper, state, thing) for thing in instance.things)
    if not _tells_heights(instance, gripper) or not isinstance(gripper, ParallelGripper):
        return (_tray(instance), *things)
    arm = (Entity("arm", {"surely reaches": robot.reach_from_above}),) if robot.reach_from_above else ()
    return (_tray(instance), *things, _hand(gripper), *arm)


def _tray(instance: BoxpackInstance) -> Entity:
    basket = instance.basket
    (x, y), (dx, dy) = basket.center, basket.size
    return Entity(
        "basket",
        {
            "center": (x, y),
            "x range": (round(x - dx / 2, 3), round(x + dx / 2, 3)),
            "y range": (round(y - dy / 2, 3), round(y + dy / 2, 3)),
            "floor height": TRAY_THICKNESS,
            **({"wall height": basket.walls} if basket.walls else {}),
        },
    )


def _hand(gripper: ParallelGripper) -> Entity:
    along, across = gripper.palm_size or (0.0, 0.0)
    return Entity(
        "hand",
        {
            "fingers reach beyond a face": round(gripper.finger_reach + OPENING_MARGIN / 2, 3),
            "finger width": round(gripper.finger_width or 0.0, 3),
            "palm length": round(along, 3),
            "palm width": round(across, 3),
        },
    )


def _entity(instance: BoxpackInstance, gripper: Gripper, state: State, thing: BoxSpec) -> Entity:
    entity = box_entity(thing.name, thing.size, state.poses.get(thing.name))
    more: dict[str, str | float] = {}
    if instance.clutter:
        more["to be packed"] = "yes" if thing in instance.boxes else "no"
    if _tells_heights(instance, gripper) and isinstance(gripper, ParallelGripper):
        size = entity.properties["size"]
        tips, palm = hand_heights(size[2] if isinstance(size, tuple) else thing.size[2], gripper)
        more |= {"fingertips": round(tips, 3), "palm": round(palm, 3)}
    return Entity(thing.name, {**entity.properties, **more}) if more else entity
