"""Rectangles seen from above."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

Point = tuple[float, float]


@dataclass(frozen=True)
class Rectangle:
    """A rectangle in the plane of the table."""

    center: Point
    size: Point
    """Full side lengths in metres."""
    direction: Point = (1.0, 0.0)
    """Unit vector along the first side."""

    @property
    def corners(self) -> NDArray[np.float64]:
        """(4, 2), counter-clockwise."""
        u = np.array(self.direction) * self.size[0] / 2
        v = np.array((-self.direction[1], self.direction[0])) * self.size[1] / 2
        c = np.array(self.center)
        return np.array([c - u - v, c + u - v, c + u + v, c - u + v])

    def overlaps(self, other: Rectangle) -> bool:
        """Whether the insides of the two have a point in common (separating axis theorem)."""
        for one, two in ((self, other), (other, self)):
            x, y = one.direction
            for axis in np.array([(x, y), (-y, x)]):
                a, b = one.corners @ axis, two.corners @ axis
                if a.max() <= b.min() or b.max() <= a.min():
                    return False
        return True

    def nearest(self, point: Point) -> Point:
        """The point of it that is nearest to a point, itself if it is in it."""
        axes = np.array([self.direction, (-self.direction[1], self.direction[0])])
        local = axes @ (np.array(point) - self.center)
        half = np.array(self.size) / 2
        x, y = (np.array(self.center) + np.clip(local, -half, half) @ axes).tolist()
        return x, y

    def contains(self, point: Point) -> bool:
        """Whether a point is in it; its edge counts."""
        x, y = self.direction
        local = (np.array(point) - self.center) @ np.array([(x, -y), (y, x)])
        return bool((np.abs(local) <= np.array(self.size) / 2).all())

    @property
    def area(self) -> float:
        """In square metres."""
        return self.size[0] * self.size[1]

    def has_room_for(self, size: Point, tolerance: float = 0.0) -> bool:
        """Whether a rectangle of this size fits into it, moved and turned in some way.

        A longer one fits slantwise if this one is wide enough: W. B. Carver, "Solution to Problem E 1225", The American
        Mathematical Monthly 64(2), 1957.

        Args:
            size: Full side lengths in metres.
            tolerance: How far it may reach out on each side, in metres.
        """
        p, q = max(size), min(size)
        a, b = (side + 2 * tolerance for side in (max(self.size), min(self.size)))
        if q > b or p <= a:
            return q <= b
        return bool(b * (p**2 + q**2) >= 2 * p * q * a + (p**2 - q**2) * np.sqrt(p**2 + q**2 - a**2))

    def overhang(self, inner: Rectangle) -> float:
        """How far the inner rectangle reaches out of this one, in metres; 0 if it is inside."""
        x, y = self.direction
        local = (inner.corners - self.center) @ np.array([(x, -y), (y, x)])
        beyond = np.abs(local) - np.array(self.size) / 2
        return max(0.0, float(beyond.max()))
