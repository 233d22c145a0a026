"""When the boxes are packed."""

from __future__ import annotations

import numpy as np

from llm3.types import GoalStatus, Pose, State
from llm3_boxpack.instance import BoxpackInstance, BoxSpec
from llm3_boxpack.rectangles import Rectangle
from llm3_bullet.poses import as_matrix

TOLERANCE = 0.001
"""A footprint may reach out of the basket by this much, in metres: what a release and rounding can cost."""


def goal_status(instance: BoxpackInstance, state: State) -> GoalStatus:
    """Every box lies in the basket with its whole footprint, within `TOLERANCE`, and none is held."""
    sentences = (_unmet(instance, box, state.poses.get(box.name)) for box in instance.boxes)
    unmet = tuple(sentence for sentence in sentences if sentence)
    return GoalStatus(not unmet, unmet)


def _unmet(instance: BoxpackInstance, box: BoxSpec, pose: Pose | None) -> str:
    if pose is None:
        return f"{box.name} is still in the gripper"
    area, shadow = instance.basket.area, _shadow(box, pose)
    if not area.overlaps(shadow):
        return f"{box.name} is not in the basket"
    beyond = area.overhang(shadow)
    return f"{box.name} reaches {beyond * 1000:.0f} mm out of the basket" if beyond > TOLERANCE else ""


def _shadow(box: BoxSpec, pose: Pose) -> Rectangle:
    """The smallest rectangle along the box's horizontal direction around all its corners, seen from above."""
    orientation = as_matrix(pose)[:3, :3]
    vertical = int(np.argmax(np.abs(orientation[2])))
    direction = orientation[:2, (vertical + 1) % 3]
    direction = direction / np.linalg.norm(direction)
    across = np.array((-direction[1], direction[0]))
    widths = np.abs(np.array([direction, across]) @ orientation[:2]) @ np.array(box.size)
    return Rectangle(
        (pose.position[0], pose.position[1]),
        (float(widths[0]), float(widths[1])),
        (float(direction[0]), float(direction[1])),
    )
