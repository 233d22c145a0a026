"""What can be drawn of a problem."""

from __future__ import annotations

from dataclasses import dataclass

from llm3.types.checks import finite


@dataclass(frozen=True)
class Shape:
    """The outline of a thing, seen from above."""

    name: str
    corners: tuple[tuple[float, float], ...]
    """x, y in metres, in the world frame, one after another around it; at least three."""
    fixed: bool = False
    """Whether it stands where it is in every state, such as a basket."""

    def __post_init__(self) -> None:
        if len(self.corners) < 3 or any(len(corner) != 2 for corner in self.corners):
            raise ValueError(f"the outline of {self.name} needs at least three corners x, y")
        for corner in self.corners:
            finite(f"a corner of {self.name}", corner)
