"""The tray that boxes are packed into, in millimetres."""

from __future__ import annotations

from dataclasses import dataclass

from llm3_boxpack.families.hand import GAP
from llm3_boxpack.families.standing import Standing

FLOOR = 10.0
"""How high the tray's floor is above the table."""
RIM = 50.0
"""How high the upper edge of its walls is: the fingers around a tall box pass over them, those around others do not."""
_THICK = 20.0
"""Walls are taken for thicker than they are: nothing stands close behind them."""


@dataclass(frozen=True)
class Tray:
    """The inside of a tray with walls."""

    low: tuple[float, float]
    high: tuple[float, float]
    """Its corners."""
    rim: float = RIM
    """How high the upper edge of its walls is."""

    @property
    def center(self) -> tuple[float, float]:
        """Of its inside."""
        return (self.low[0] + self.high[0]) / 2, (self.low[1] + self.high[1]) / 2

    @property
    def size(self) -> tuple[float, float]:
        """Full side lengths."""
        return self.high[0] - self.low[0], self.high[1] - self.low[1]

    @property
    def walls(self) -> tuple[Standing, ...]:
        """As things that are in the way."""
        (x, y), (dx, dy) = self.center, self.size
        return (
            Standing("front", self.low[0] - _THICK / 2, y, _THICK, dy + 2 * _THICK, self.rim),
            Standing("back", self.high[0] + _THICK / 2, y, _THICK, dy + 2 * _THICK, self.rim),
            Standing("right", x, self.low[1] - _THICK / 2, dx, _THICK, self.rim),
            Standing("left", x, self.high[1] + _THICK / 2, dx, _THICK, self.rim),
        )

    def holds(self, box: Standing) -> bool:
        """Whether a box stands in it, with a gap to each wall."""
        ends = zip((box.x, box.y), (box.dx, box.dy), self.low, self.high, strict=True)
        return all(low + GAP <= at - side / 2 and at + side / 2 <= high - GAP for at, side, low, high in ends)
