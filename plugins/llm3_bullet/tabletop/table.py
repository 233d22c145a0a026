"""The table, and the surfaces on it that something can be put down on."""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import dataclass
from math import isfinite

from llm3.types import Pose
from llm3_bullet.scene import Box
from llm3_bullet.tabletop.rectangles import Rectangle

TABLE = "table"
"""What failures and goals call it."""
TABLE_TOP = Rectangle((0.5, 0.0), (2.0, 3.0))
"""The table's top, in metres, at the height 0: it reaches farther than the arm on all sides."""
THICKNESS = 0.05
ON_TABLE = "such that all of it is on the table, x -0.5 to 1.5 m and y -1.5 to 1.5 m"
"""What a position has to be, in words."""


def table() -> Box:
    """The table as a thing of the scene."""
    return Box(TABLE, (*TABLE_TOP.size, THICKNESS), Pose((*TABLE_TOP.center, -THICKNESS / 2)), fixed=True)


def is_on_table(area: Rectangle) -> bool:
    """Whether all of it is on the table."""
    return all(map(isfinite, area.center)) and TABLE_TOP.overhang(area) == 0.0


@dataclass(frozen=True)
class Surface:
    """A level surface above the table, such as the floor of a tray."""

    area: Rectangle
    height: float
    """Above the table, in metres."""


def support_height(surfaces: Iterable[Surface], footprint: Rectangle) -> float:
    """How high what a box with this footprint would stand on is, in metres: a surface that it touches, or the table."""
    return max((surface.height for surface in surfaces if surface.area.overlaps(footprint)), default=0.0)
