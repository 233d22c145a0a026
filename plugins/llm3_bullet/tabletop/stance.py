"""How a box stands, and what it covers, seen from above."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from llm3.types import Pose
from llm3_bullet.poses import as_matrix, turned
from llm3_bullet.scene import Size
from llm3_bullet.tabletop.rectangles import Rectangle

UPRIGHT = np.cos(np.radians(5.0))
"""A box counts as standing on a face if that face is level within 5 degrees."""


@dataclass(frozen=True)
class Stance:
    """Which face a box stands on, and which way it faces: what is left of a pose when one looks from above."""

    yaw: float
    """Rotation of the box about the vertical, in radians: the direction of its first horizontal axis."""
    axes: tuple[int, int, int]
    """Which of the box's own axes is the first horizontal one, the second, and the vertical one."""
    base: NDArray[np.float64]
    """(3, 3): the box's orientation on this face at yaw 0."""
    extent: Size
    """Side lengths along these axes, in metres."""

    def orientation(self, yaw: float) -> NDArray[np.float64]:
        """(3, 3): the box's orientation on this face at another yaw."""
        return np.asarray(turned(yaw) @ self.base)

    def footprint(self, center: tuple[float, float], yaw: float | None = None) -> Rectangle:
        """What the box covers, standing at `center` with this yaw or with its own."""
        angle = self.yaw if yaw is None else yaw
        return Rectangle(center, self.extent[:2], (float(np.cos(angle)), float(np.sin(angle))))


def stance(orientation: NDArray[np.float64], size: Size) -> Stance | None:
    """How a box of this size stands, or None if it leans.

    Args:
        orientation: (3, 3), the box's axes as columns in the world frame.
        size: Its side lengths along its own axes, in metres.
    """
    vertical = int(np.argmax(np.abs(orientation[2])))
    if abs(orientation[2, vertical]) < UPRIGHT:
        return None
    first, second = (a for a in range(3) if a != vertical)
    yaw = float(np.arctan2(orientation[1, first], orientation[0, first]))
    base = np.asarray(turned(-yaw) @ orientation).round()
    return Stance(yaw, (first, second, vertical), base, (size[first], size[second], size[vertical]))


def shadow(pose: Pose, size: Size) -> Rectangle:
    """The smallest rectangle along a box's horizontal direction around all its corners, seen from above."""
    orientation = as_matrix(pose)[:3, :3]
    vertical = int(np.argmax(np.abs(orientation[2])))
    direction = orientation[:2, (vertical + 1) % 3]
    direction = direction / np.linalg.norm(direction)
    across = np.array((-direction[1], direction[0]))
    widths = np.abs(np.array([direction, across]) @ orientation[:2]) @ np.array(size)
    return Rectangle(
        (pose.position[0], pose.position[1]),
        (float(widths[0]), float(widths[1])),
        (float(direction[0]), float(direction[1])),
    )
