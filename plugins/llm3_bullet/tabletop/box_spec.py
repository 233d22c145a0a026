"""Boxes as instance files hold them. Lengths in metres, angles in radians."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from math import cos, isfinite, sin
from typing import ClassVar

from llm3.types import ITSELF, Pose
from llm3_bullet.scene import Box
from llm3_bullet.tabletop.rectangles import Rectangle
from llm3_bullet.tabletop.table import ON_TABLE, TABLE, is_on_table


@dataclass(frozen=True)
class BoxShape:
    """A box, wherever it is. A domain with furniture of its own makes a subclass that names it in `taken`."""

    taken: ClassVar[tuple[str, ...]] = (TABLE, ITSELF)
    """Names that failures use for what is no box."""
    kind: ClassVar[str] = "box"
    """What messages call it."""

    name: str
    size: tuple[float, float, float]
    """Full side lengths along the box's own x, y and z."""

    def __post_init__(self) -> None:
        if not self.name.isidentifier():
            raise ValueError(
                f"a {self.kind}'s name must be letters, digits and underscores, no digit first, not {self.name!r}"
            )
        if self.name in self.taken:
            raise ValueError(
                f"a {self.kind} cannot be called {self.name!r}; these names are taken: {', '.join(self.taken)}"
            )
        if not all(0.005 <= side <= 0.5 for side in self.size):
            raise ValueError(f"the sides of {self.name} must be 0.005 to 0.5 m, not {list(self.size)}")


@dataclass(frozen=True)
class BoxSpec(BoxShape):
    """A box, and where it starts."""

    position: tuple[float, float]
    """x, y of its centre; it stands on whatever is below."""
    yaw: float = 0.0
    """Rotation about the vertical."""

    def __post_init__(self) -> None:
        super().__post_init__()
        if not isfinite(self.yaw):
            raise ValueError(f"the yaw of {self.name} must be a finite number of radians, not {self.yaw}")
        if not is_on_table(self.footprint):
            raise ValueError(f"the position of {self.name} must be {ON_TABLE}, not {list(self.position)}")

    @property
    def footprint(self) -> Rectangle:
        """What it covers at its start."""
        return Rectangle(self.position, (self.size[0], self.size[1]), (cos(self.yaw), sin(self.yaw)))

    def standing(self, height: float) -> Box:
        """The box at its start, on something of this height in metres."""
        return Box(self.name, self.size, upright(self.position, height + self.size[2] / 2, self.yaw))


def check_boxes(boxes: Sequence[BoxSpec]) -> None:
    """See that no two boxes have the same name or start in one another: for the `__post_init__` of an instance.

    Raises:
        ValueError: Two do.
    """
    for index, box in enumerate(boxes):
        for other in boxes[:index]:
            if box.name == other.name:
                raise ValueError(f"two things are called {box.name}")
            if box.footprint.overlaps(other.footprint):
                raise ValueError(f"{other.name} and {box.name} start in one another")


def upright(position: tuple[float, float], height: float, yaw: float) -> Pose:
    """The pose of a box whose own z axis points up.

    Args:
        position: x, y of its centre.
        height: Of its centre.
        yaw: Its rotation about the vertical.
    """
    return Pose((*position, height), (0.0, 0.0, sin(yaw / 2), cos(yaw / 2)))
