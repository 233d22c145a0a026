"""One box-packing problem, as it stands in an instance file."""

from __future__ import annotations

from dataclasses import dataclass
from math import cos, isfinite, sin

from llm3.types import ITSELF
from llm3_boxpack.rectangles import Rectangle

TRAY_THICKNESS = 0.01
"""Thickness in metres of the plate that is the basket's floor."""
TABLE = Rectangle((0.5, 0.0), (2.0, 3.0))
"""The table's top, in metres: it reaches farther than the arm on all sides."""
WALLS = ("basket_wall_front", "basket_wall_back", "basket_wall_right", "basket_wall_left")
RESERVED = ("table", "basket", *WALLS, ITSELF)
"""Names that failures use for what is no box."""
MOST_BOXES = 100
"""A plan of more than 200 actions would not be read, and each box takes two."""
ON_TABLE = "such that all of it is on the table, x -0.5 to 1.5 m and y -1.5 to 1.5 m"


@dataclass(frozen=True)
class BoxSpec:
    """A box and where it starts. Lengths in metres, angles in radians."""

    name: str
    size: tuple[float, float, float]
    """Full side lengths along the box's own x, y and z."""
    position: tuple[float, float]
    """x, y of its centre; it stands on whatever is below, the table or the basket."""
    yaw: float = 0.0
    """Rotation about the vertical."""

    def __post_init__(self) -> None:
        if not self.name.isidentifier():
            raise ValueError(f"a box's name must be letters, digits and underscores, no digit first, not {self.name!r}")
        if self.name in RESERVED:
            raise ValueError(f"a box cannot be called {self.name!r}; these names are taken: {', '.join(RESERVED)}")
        if not all(0.005 <= side <= 0.5 for side in self.size):
            raise ValueError(f"the sides of {self.name} must be 0.005 to 0.5 m, not {list(self.size)}")
        if not isfinite(self.yaw):
            raise ValueError(f"the yaw of {self.name} must be a finite number of radians, not {self.yaw}")
        if not _on_table(self.footprint):
            raise ValueError(f"the position of {self.name} must be {ON_TABLE}, not {list(self.position)}")

    @property
    def footprint(self) -> Rectangle:
        """What it covers at its start."""
        c, s = cos(self.yaw), sin(self.yaw)
        return Rectangle(self.position, (self.size[0], self.size[1]), (c, s))


@dataclass(frozen=True)
class BasketSpec:
    """The basket: a flat tray whose sides are parallel to x and y. Lengths in metres."""

    center: tuple[float, float]
    size: tuple[float, float]
    """Full side lengths of its inside along x and y."""

    def __post_init__(self) -> None:
        if not all(0.02 <= side <= 2.0 for side in self.size):
            raise ValueError(f"the basket's sides must be 0.02 to 2 m, not {list(self.size)}")
        if not _on_table(self.area):
            raise ValueError(f"the basket's center must be {ON_TABLE}, not {list(self.center)}")

    @property
    def area(self) -> Rectangle:
        """Its inside, seen from above."""
        return Rectangle(self.center, self.size)


@dataclass(frozen=True)
class BoxpackInstance:
    """Which boxes there are, where they start, and the basket they belong in."""

    basket: BasketSpec
    boxes: tuple[BoxSpec, ...]

    def __post_init__(self) -> None:
        if not 1 <= len(self.boxes) <= MOST_BOXES:
            raise ValueError(f"there must be 1 to {MOST_BOXES} boxes, not {len(self.boxes)}")
        for index, box in enumerate(self.boxes):
            if self.basket.area.overlaps(box.footprint) and self.basket.area.overhang(box.footprint) > 0:
                raise ValueError(f"{box.name} starts on the basket's edge; it must be all inside or all outside")
            for other in self.boxes[:index]:
                if box.name == other.name:
                    raise ValueError(f"two boxes are called {box.name}")
                if box.footprint.overlaps(other.footprint):
                    raise ValueError(f"{other.name} and {box.name} start in one another")


def _on_table(area: Rectangle) -> bool:
    return all(map(isfinite, area.center)) and TABLE.overhang(area) == 0.0
