"""Boxes that stand with their sides parallel to x and y, in whole millimetres: no rounding comes into comparisons."""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import dataclass, replace
from math import hypot

import numpy as np
from numpy.typing import NDArray

QUARTER_TURN = 1.571
"""In radians, as a model would write it."""


@dataclass(frozen=True)
class Standing:
    """A box where it stands, or anything else with the form of one. Millimetres, from the table's surface upwards."""

    name: str
    x: float
    y: float
    """Of its centre."""
    dx: float
    dy: float
    """Full side lengths along x and y."""
    top: float
    """How high its upper face is."""
    bottom: float = 0.0
    """How high its lower face is."""

    @property
    def height(self) -> float:
        """Between the two faces."""
        return self.top - self.bottom

    @property
    def area(self) -> float:
        """What it covers, in square millimetres."""
        return self.dx * self.dy

    @property
    def is_along_y(self) -> bool:
        """Whether it is longer along y than along x."""
        return self.dy > self.dx

    @property
    def distance(self) -> float:
        """Of its centre from the arm's base."""
        return hypot(self.x, self.y)

    def at(self, x: float, y: float) -> Standing:
        """The same somewhere else."""
        return replace(self, x=x, y=y)

    def turned(self) -> Standing:
        """The same, turned by a quarter."""
        return replace(self, dx=self.dy, dy=self.dx)

    def raised(self, bottom: float) -> Standing:
        """The same, standing on something of this height."""
        return replace(self, bottom=bottom, top=bottom + self.height)


Table = NDArray[np.float64]
"""(N, 5): x, y, dx, dy and top of several."""


def table_of(things: Iterable[Standing]) -> Table:
    """Several as numbers."""
    rows = [(t.x, t.y, t.dx, t.dy, t.top) for t in things]
    return np.array(rows, dtype=float).reshape(-1, 5)
