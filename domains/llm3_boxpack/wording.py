"""What a model is told of the task and the world."""

from __future__ import annotations

from llm3.types import Entity, State
from llm3_boxpack.grasps import OPENING_MARGIN, narrowest, widest
from llm3_boxpack.instance import TRAY_THICKNESS, BoxpackInstance
from llm3_boxpack.layout import stance
from llm3_bullet.poses import as_matrix
from llm3_bullet.robot import Gripper, ParallelGripper, SuctionGripper


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
        f"{_of_suction(gripper) if isinstance(gripper, SuctionGripper) else _of_fingers(gripper)}"
    )


def _of_fingers(gripper: ParallelGripper) -> str:
    room = gripper.finger_reach + OPENING_MARGIN
    return (
        "The gripper takes a box from above between two fingers, on two opposite side faces no more than "
        f"{widest(gripper):g} m apart: the closer pair, or for a square box the pair along its "
        "own x direction (that of theta), and the other one only if the first is blocked. The fingers need about "
        f"{room:.3f} m of free space beside these two faces, when they take a box and when they let go of it. Then "
        "the hand moves straight up."
    )


def _of_suction(gripper: SuctionGripper) -> str:
    return (
        "The gripper is a suction cup, which takes a box from above by the middle of its upper face; the face must be "
        f"at least {narrowest(gripper):g} m wide. It needs no free space beside the box. When it has taken a box, or "
        "let go of it, it moves straight up."
    )


def describe(instance: BoxpackInstance, state: State) -> tuple[Entity, ...]:
    """The basket and the boxes, to the millimetre."""
    basket = instance.basket
    (x, y), (dx, dy) = basket.center, basket.size
    entities = [
        Entity(
            "basket",
            {
                "center": (x, y),
                "x range": (round(x - dx / 2, 3), round(x + dx / 2, 3)),
                "y range": (round(y - dy / 2, 3), round(y + dy / 2, 3)),
                "floor height": TRAY_THICKNESS,
            },
        )
    ]
    for box in instance.boxes:
        if box.name not in state.poses:
            entities.append(Entity(box.name, {"size": box.size, "position": "in the gripper"}))
            continue
        pose = state.poses[box.name]
        standing = stance(as_matrix(pose)[:3, :3], box.size)
        entities.append(
            Entity(
                box.name,
                {
                    "position": tuple(round(v, 3) + 0.0 for v in pose.position),
                    "size": standing.extent if standing else box.size,
                    **({"theta": round(standing.yaw, 3) + 0.0} if standing else {"posture": "leaning"}),
                },
            )
        )
    return tuple(entities)
