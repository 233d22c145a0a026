"""The fixed things of the scene."""

from __future__ import annotations

from llm3.types import Pose
from llm3_boxpack.instance import TRAY_THICKNESS, WALLS, BasketSpec
from llm3_bullet.scene import Box
from llm3_bullet.tabletop.table import table

WALL_THICKNESS = 0.004


def furniture(basket: BasketSpec) -> tuple[Box, ...]:
    """The table, the basket's floor and, if they have a height, its walls."""
    (x, y), (dx, dy) = basket.center, basket.size
    tray = Box("basket", (dx, dy, TRAY_THICKNESS), Pose((x, y, TRAY_THICKNESS / 2)), fixed=True)
    if not basket.walls:
        return table(), tray
    z, t = basket.walls / 2, WALL_THICKNESS
    walls = (
        ((t, dy + 2 * t), (x - (dx + t) / 2, y)),
        ((t, dy + 2 * t), (x + (dx + t) / 2, y)),
        ((dx, t), (x, y - (dy + t) / 2)),
        ((dx, t), (x, y + (dy + t) / 2)),
    )
    return (
        table(),
        tray,
        *(
            Box(name, (*size, basket.walls), Pose((*center, z)), fixed=True)
            for name, (size, center) in zip(WALLS, walls, strict=True)
        ),
    )
