"""What a model is told of the palm, which is in the way where something stands higher than what is taken."""

from __future__ import annotations

from math import ceil

import numpy as np

from llm3_bullet.hulls import MARGIN
from llm3_bullet.robot import SuctionGripper
from llm3_bullet.tabletop.grasps import ABOVE_CENTER, PALM_GAP
from llm3_bullet.workcell import Workcell


def palm_text(workcell: Workcell) -> str:
    """How far the palm and the tips of the fingers reach, in prose; empty for a gripper without fingers.

    Lengths are those of the robot's hulls, rounded up to the millimetre.
    """
    gripper = workcell.gripper
    if isinstance(gripper, SuctionGripper):
        return ""
    model = workcell.model
    frames = workcell.kinematics.link_frames(np.array([model.home]), 0.0)[0]
    in_tool = np.linalg.inv(frames[model.tool]) @ frames
    links = [model.link(name) for name in gripper.links]
    points = np.concatenate(
        [workcell.checker.hulls[link] @ in_tool[link, :3, :3].T + in_tool[link, :3, 3] for link in links]
    )
    closing = np.array(gripper.closing_axis)
    palm = points[points[:, 2] <= -gripper.palm_height]
    along, across = (_up(np.abs(palm @ axis).max()) for axis in (closing, np.cross((0.0, 0.0, 1.0), closing)))
    tips = _up(points[:, 2].max() + gripper.palm_height)
    return (
        f"Above the fingers is the palm. Seen from above, it reaches {along:.3f} m to either side of the object's "
        f"middle in the direction in which the fingers close, and {across:.3f} m across that. Its underside is "
        f"{gripper.palm_height + ABOVE_CENTER:.3f} m above the object's middle (for an object lower than "
        f"{4 * ABOVE_CENTER:g} m, {gripper.palm_height:g} m and a quarter of the object's height), but at least "
        f"{PALM_GAP:g} m above the object; the tips of the fingers are {tips:.3f} m below that. What is higher than "
        "the underside must not be in the way of the palm, and what is higher than the tips not in that of the fingers."
    )


def _up(length: float) -> float:
    return ceil(round((length + MARGIN) * 1000, 3)) / 1000
