"""Discs and rectangles in the plane, and how far apart they are.

Everything is one shape: a rectangle that is grown by a radius. A disc is a rectangle without sides, a box one without
a radius. So there is one test for disc and disc, disc and box, and box and box.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from math import inf

import numpy as np
from numpy.typing import NDArray

from llm3.types import Vector

Array = NDArray[np.float64]


@dataclass(frozen=True)
class Body:
    """A rectangle that is grown by a radius. Lengths in metres, angles in radians."""

    name: str
    center: tuple[float, float]
    sides: tuple[float, float] = (0.0, 0.0)
    """Full side lengths of the rectangle."""
    angle: float = 0.0
    """How far it is turned, counter-clockwise."""
    radius: float = 0.0


class Separation:
    """How far some bodies that move along with a point are from others that stand still, for many places of the point.

    Nothing turns, so the directions in which two bodies could be told apart are the same everywhere.
    """

    def __init__(self, moving: Sequence[Body], standing: Sequence[Body]) -> None:
        """Take the bodies.

        Args:
            moving: Their centres are counted from the point.
            standing: Where they are.
        """
        self.pairs = [(a, b) for a in moving for b in standing]
        first, second = [a for a, _ in self.pairs], [b for _, b in self.pairs]
        self._offset = _centers(second) - _centers(first)
        self._axes = np.stack([_axes(first), _axes(second)], axis=1)  # (P, 2, 2, 2): body, axis, x and y
        self._halves = np.stack([_halves(first), _halves(second)], axis=1)  # (P, 2, 2): body, side
        shares = np.abs(np.einsum("pbai,pcki->pback", self._axes, self._axes))
        self._reach = np.einsum("pback,pck->pba", shares, self._halves).reshape(-1, 4)
        self._radius = np.array([a.radius + b.radius for a, b in self.pairs])
        signs = np.array([(1, 1), (1, -1), (-1, -1), (-1, 1)])
        self._corners = np.einsum("sk,pbk,pbki->pbsi", signs, self._halves, self._axes)

    def gaps(self, points: Vector, horizon: float = inf) -> Array:
        """The distance of each pair, (N, P), in metres; of two bodies in one another, minus the depth.

        Depth is the shortest way by which the one would have to be moved to be out of the other.

        Args:
            points: Where the point is, (N, 2).
            horizon: Of pairs that are at least so far apart, any number from here to their distance may be told.
        """
        count = len(self.pairs)
        pair = np.tile(np.arange(count), len(points))
        return self.gaps_of(np.repeat(points, count, axis=0), pair, horizon).reshape(len(points), count)

    def gaps_of(self, points: Vector, pair: NDArray[np.intp], horizon: float = inf) -> Array:
        """The same of one pair at each point, (E,).

        Args:
            points: (E, 2).
            pair: The number of the pair at each point, (E,).
            horizon: As above.
        """
        offset = self._offset[pair] - points
        axes, radius = self._axes.reshape(-1, 4, 2)[pair], self._radius[pair]
        along = np.abs(offset[:, 0, None] * axes[:, :, 0] + offset[:, 1, None] * axes[:, :, 1]) - self._reach[pair]
        gaps: Array = along.max(axis=1, initial=-inf)
        # By the separating axis theorem, the rectangles overlap where this is negative, and it is their depth. Where
        # it is not, corners may be farther apart than the axes tell.
        (near,) = ((gaps > 0) & (gaps < horizon + radius)).nonzero()
        if len(near):
            gaps[near] = self._distances(offset[near], pair[near])
        return np.asarray(gaps - radius)

    def boxes(self, distance: float) -> Iterator[tuple[Array, Array]]:
        """For each pair the least and the largest x and y of the point at which it can be closer than a distance."""
        sizes = np.abs(self._corners).max(axis=2).sum(axis=1) + (self._radius + distance)[:, None]
        yield from zip(self._offset - sizes, self._offset + sizes, strict=True)

    def _distances(self, offset: Array, pair: NDArray[np.intp]) -> Array:
        """Of rectangles that are apart, (E,): of two such, a corner of the one is as near as any point."""
        best = np.full(len(pair), inf)
        for body, sign in ((0, 1.0), (1, -1.0)):
            # The other body's corners, seen from the centre of this one.
            corners = sign * offset[:, None, :] + self._corners[pair, 1 - body]
            local = np.abs(np.einsum("eai,esi->esa", self._axes[pair, body], corners))
            beyond = np.maximum(local - self._halves[pair, body][:, None, :], 0.0)
            best = np.minimum(best, np.hypot(beyond[..., 0], beyond[..., 1]).min(axis=1))
        return best


def _centers(bodies: Sequence[Body]) -> Array:
    return np.array([body.center for body in bodies], dtype=float).reshape(-1, 2)


def _halves(bodies: Sequence[Body]) -> Array:
    return np.array([body.sides for body in bodies], dtype=float).reshape(-1, 2) / 2


def _axes(bodies: Sequence[Body]) -> Array:
    """(P, 2, 2): the directions of both sides."""
    angles = np.array([body.angle for body in bodies], dtype=float)
    c, s = np.cos(angles), np.sin(angles)
    return np.stack([np.stack([c, s], axis=1), np.stack([-s, c], axis=1)], axis=1)
