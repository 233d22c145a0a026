"""What a model is told of the gripper and of boxes."""

from __future__ import annotations

from math import ceil

from llm3.types import Entity, Pose
from llm3_bullet.hulls import MARGIN
from llm3_bullet.poses import as_matrix
from llm3_bullet.robot import Gripper, ParallelGripper, SuctionGripper
from llm3_bullet.scene import Size
from llm3_bullet.tabletop.grasps import ABOVE_CENTER, OPENING_MARGIN, PALM_GAP, narrowest, widest
from llm3_bullet.tabletop.stance import stance


def gripper_text(gripper: Gripper, kind: str = "box") -> str:
    """How a gripper takes boxes and how much room it needs, in prose; lengths are those of the gripper.

    Args:
        gripper: What takes them.
        kind: What the domain calls them.
    """
    return _of_suction(gripper, kind) if isinstance(gripper, SuctionGripper) else _of_fingers(gripper, kind)


def _of_fingers(gripper: ParallelGripper, kind: str) -> str:
    one, room = _one(kind), gripper.finger_reach + OPENING_MARGIN / 2
    return (
        f"The gripper takes {one} from above between two fingers, on two opposite side faces no more than "
        f"{widest(gripper):g} m apart: the closer pair, or for a square {kind} the pair along its "
        "own x direction (that of theta), and the other one only if the first is blocked. The fingers need about "
        f"{room:.3f} m of free space beside these two faces, when they take {one} and when they let go of it. Then "
        "the hand moves straight up."
    )


def _of_suction(gripper: SuctionGripper, kind: str) -> str:
    one = _one(kind)
    return (
        f"The gripper is a suction cup, which takes {one} from above by the middle of its upper face; the face must "
        f"be at least {narrowest(gripper):g} m wide. It needs no free space beside the {kind}. When it has taken "
        f"{one}, or let go of it, it moves straight up."
    )


def hand_text(gripper: Gripper, kind: str = "box") -> str:
    """How far the palm and the tips of the fingers reach, in prose; empty where it is not known, or without fingers.

    Lengths are rounded up, as what collides is a little thicker than what is drawn.

    Args:
        gripper: What takes the boxes.
        kind: What the domain calls them.
    """
    if isinstance(gripper, SuctionGripper) or gripper.palm_size is None:
        return ""
    along, across = (_up(length / 2) for length in gripper.palm_size)
    palm, tips = gripper.palm_height, _up(gripper.palm_height + gripper.tip_depth)
    return (
        f"Above the fingers is the palm. Seen from above, it reaches {along:.3f} m to either side of the {kind}'s "
        f"middle in the direction in which the fingers close, and {across:.3f} m across that. Its underside is "
        f"{palm + ABOVE_CENTER:.3f} m above the {kind}'s middle (for {_one(kind)} lower than {4 * ABOVE_CENTER:g} m, "
        f"{palm:g} m and a quarter of the {kind}'s height), but at least {PALM_GAP:g} m above the {kind}; the tips of "
        f"the fingers are {tips:.3f} m below that. What is higher than the underside must not be in the way of the "
        "palm, and what is higher than the tips not in that of the fingers."
    )


def _one(kind: str) -> str:
    """With its article."""
    return f"{'an' if kind[0] in 'aeiou' else 'a'} {kind}"


def _up(length: float) -> float:
    """With what collides beyond it, in metres, to the next millimetre."""
    return ceil(round((length + MARGIN) * 1000, 3)) / 1000


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
