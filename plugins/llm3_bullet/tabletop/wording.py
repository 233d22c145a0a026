"""What a model is told of the gripper and of boxes."""

from __future__ import annotations

from collections.abc import Iterable

from llm3.types import Entity, Pose
from llm3_bullet.poses import as_matrix
from llm3_bullet.robot import Gripper, ParallelGripper, SuctionGripper
from llm3_bullet.scene import Size
from llm3_bullet.tabletop.grasps import OPENING_MARGIN, narrowest, under_palm, widest
from llm3_bullet.tabletop.stance import stance


def gripper_text(gripper: Gripper, kind: str = "box") -> str:
    """How a gripper takes boxes and how much room it needs, in prose; lengths are those of the gripper.

    Args:
        gripper: What takes them.
        kind: What the domain calls them.
    """
    return _of_suction(gripper, kind) if isinstance(gripper, SuctionGripper) else _of_fingers(gripper, kind)


def _of_fingers(gripper: ParallelGripper, kind: str) -> str:
    room = gripper.finger_reach + OPENING_MARGIN
    return (
        f"The gripper takes a {kind} from above between two fingers, on two opposite side faces no more than "
        f"{widest(gripper):g} m apart: the closer pair, or for a square {kind} the pair along its "
        "own x direction (that of theta), and the other one only if the first is blocked. The fingers need about "
        f"{room:.3f} m of free space beside these two faces, when they take a {kind} and when they let go of it. Then "
        "the hand moves straight up."
    )


def _of_suction(gripper: SuctionGripper, kind: str) -> str:
    return (
        f"The gripper is a suction cup, which takes a {kind} from above by the middle of its upper face; the face must "
        f"be at least {narrowest(gripper):g} m wide. It needs no free space beside the {kind}. When it has taken a "
        f"{kind}, or let go of it, it moves straight up."
    )


def hand_text(gripper: Gripper, heights: Iterable[float], kind: str = "box") -> str:
    """How much room the hand needs above the fingers, in prose; empty where its size is not known.

    Args:
        gripper: What takes the boxes.
        heights: Of the boxes that it may have to take, in metres; at least one.
        kind: What the domain calls them.
    """
    if isinstance(gripper, SuctionGripper) or gripper.palm_size is None:
        return ""
    along, across = gripper.palm_size
    room = min(under_palm(height, gripper) for height in heights)
    return (
        f"The hand above the fingers is {along:.3f} m long in the direction in which they close, and {across:.3f} m "
        f"wide. Its underside is {room:.3f} m or little more above the upper face of the {kind} that it takes or puts "
        "down: what is higher must not be where the hand comes."
    )


def box_entity(name: str, size: Size, pose: Pose | None, **others: str) -> Entity:
    """A box as the model reads it, to the millimetre.

    Args:
        name: The box's.
        size: Its sides along its own axes, in metres.
        pose: Where it is; None for the box in the gripper.
        others: What else is known of it.
    """
    if pose is None:
        return Entity(name, {"size": size, "position": "in the gripper", **others})
    standing = stance(as_matrix(pose)[:3, :3], size)
    return Entity(
        name,
        {
            "position": tuple(round(v, 3) + 0.0 for v in pose.position),
            "size": standing.extent if standing else size,
            **({"theta": round(standing.yaw, 3) + 0.0} if standing else {"posture": "leaning"}),
            **others,
        },
    )
