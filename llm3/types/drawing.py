"""What can be drawn of a problem."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass

from llm3.types.checks import finite
from llm3.types.frozen import FrozenDict

Color = tuple[float, float, float]
"""Red, green and blue, each 0 to 1."""
GREY: Color = (0.6, 0.6, 0.6)
NAMED: Mapping[str, Color] = FrozenDict(
    {
        "red": (0.83, 0.20, 0.18),
        "blue": (0.16, 0.38, 0.75),
        "green": (0.20, 0.58, 0.32),
        "tan": (0.86, 0.70, 0.47),
        "cyan": (0.20, 0.70, 0.75),
        "yellow": (0.92, 0.78, 0.20),
        "orange": (0.90, 0.49, 0.13),
        "purple": (0.49, 0.27, 0.62),
        "pink": (0.90, 0.55, 0.65),
        "brown": (0.60, 0.42, 0.27),
        "black": (0.10, 0.10, 0.10),
        "white": (0.95, 0.95, 0.95),
        "robot": (0.13, 0.13, 0.13),
    }
)
"""By the first word of a name."""


def color_of(name: str) -> Color:
    """The colour that a name begins with, such as red for ``red_box``, or grey."""
    return NAMED.get(name.partition("_")[0], GREY)


@dataclass(frozen=True)
class Camera:
    """Where one looks from."""

    target: tuple[float, float, float] = (0.5, 0.0, 0.1)
    """What is in the middle, in metres."""
    distance: float = 1.5
    yaw: float = 55.0
    """Degrees about the vertical."""
    pitch: float = -35.0
    """Degrees; negative looks down."""


@dataclass(frozen=True)
class Shape:
    """The outline of a thing, seen from above."""

    name: str
    corners: tuple[tuple[float, float], ...]
    """x, y in metres, in the world frame, one after another around it; at least three."""
    fixed: bool = False
    """Whether it stands where it is in every state, such as a basket."""
    color: Color | None = None
    """None: the one that its name begins with; see `color_of`."""
    robot: bool = False
    """Whether it is a part of the robot, and not of the layout."""

    def __post_init__(self) -> None:
        if len(self.corners) < 3 or any(len(corner) != 2 for corner in self.corners):
            raise ValueError(f"the outline of {self.name} needs at least three corners x, y")
        for corner in self.corners:
            finite(f"a corner of {self.name}", corner)
