"""What stands where: the fixed things of the scene, and the poses of boxes."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from llm3.types import Pose
from llm3_boxpack.instance import TABLE, TRAY_THICKNESS, WALLS, BasketSpec
from llm3_boxpack.rectangles import Rectangle
from llm3_bullet.poses import turned
from llm3_bullet.scene import Box

TABLE_THICKNESS = 0.05
WALL_THICKNESS = 0.004
UPRIGHT = np.cos(np.radians(5.0))
"""A box counts as standing on a face if that face is level within 5 degrees."""


def furniture(basket: BasketSpec, wall_height: float) -> tuple[Box, ...]:
    """The table, the basket's floor and, if they have a height, its walls."""
    (x, y), (dx, dy) = basket.center, basket.size
    table = Box("table", (*TABLE.size, TABLE_THICKNESS), Pose((*TABLE.center, -TABLE_THICKNESS / 2)), fixed=True)
    tray = Box("basket", (dx, dy, TRAY_THICKNESS), Pose((x, y, TRAY_THICKNESS / 2)), fixed=True)
    if not wall_height:
        return table, tray
    z, t = wall_height / 2, WALL_THICKNESS
    walls = (
        ((t, dy + 2 * t), (x - (dx + t) / 2, y)),
        ((t, dy + 2 * t), (x + (dx + t) / 2, y)),
        ((dx, t), (x, y - (dy + t) / 2)),
        ((dx, t), (x, y + (dy + t) / 2)),
    )
    return (
        table,
        tray,
        *(
            Box(name, (*size, wall_height), Pose((*center, z)), fixed=True)
            for name, (size, center) in zip(WALLS, walls, strict=True)
        ),
    )


def support_height(basket: BasketSpec, footprint: Rectangle) -> float:
    """The height in metres of what a box with this footprint would stand on: the basket's floor or the table."""
    return TRAY_THICKNESS if basket.area.overlaps(footprint) else 0.0


@dataclass(frozen=True)
class Stance:
    """Which face a box stands on, and which way it faces: what is left of a pose when one looks from above."""

    yaw: float
    """Rotation of the box about the vertical, in radians: the direction of its first horizontal axis."""
    axes: tuple[int, int, int]
    """Which of the box's own axes is the first horizontal one, the second, and the vertical one."""
    base: NDArray[np.float64]
    """(3, 3): the box's orientation on this face at yaw 0."""
    extent: tuple[float, float, float]
    """Side lengths along these axes, in metres."""

    def orientation(self, yaw: float) -> NDArray[np.float64]:
        """(3, 3): the box's orientation on this face at another yaw."""
        return np.asarray(turned(yaw) @ self.base)

    def footprint(self, center: tuple[float, float], yaw: float | None = None) -> Rectangle:
        """What the box covers, standing at `center` with this yaw or with its own."""
        angle = self.yaw if yaw is None else yaw
        return Rectangle(center, self.extent[:2], (float(np.cos(angle)), float(np.sin(angle))))


def stance(orientation: NDArray[np.float64], size: tuple[float, float, float]) -> Stance | None:
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
