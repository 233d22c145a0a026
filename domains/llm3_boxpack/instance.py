"""One box-packing problem, as it stands in an instance file."""

from __future__ import annotations

from dataclasses import dataclass
from math import cos, isfinite, sin

from llm3_boxpack.rectangles import Rectangle

TRAY_THICKNESS = 0.01
"""Thickness in metres of the plate that is the basket's floor."""
LARGEST = 2.0
"""No length or coordinate in an instance is larger, in metres."""


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
            raise ValueError(f"a box's name must be letters, digits and underscores, not {self.name!r}")
        if not all(0.005 <= side <= 0.5 for side in self.size):
            raise ValueError(f"the sides of {self.name} must be 0.005 to 0.5 m, not {list(self.size)}")
        if not all(abs(x) <= LARGEST for x in self.position) or not isfinite(self.yaw):
            raise ValueError(f"the position of {self.name} must be within {LARGEST} m, not {list(self.position)}")

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
        if not all(0.02 <= side <= LARGEST for side in self.size):
            raise ValueError(f"the basket's sides must be 0.02 to {LARGEST} m, not {list(self.size)}")
        if not all(abs(x) <= LARGEST for x in self.center):
            raise ValueError(f"the basket's center must be within {LARGEST} m, not {list(self.center)}")

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
        if not self.boxes:
            raise ValueError("there must be at least one box")
        for index, box in enumerate(self.boxes):
            for other in self.boxes[:index]:
                if box.name == other.name:
                    raise ValueError(f"two boxes are called {box.name}")
                if box.footprint.overlaps(other.footprint):
                    raise ValueError(f"{other.name} and {box.name} start in one another")
