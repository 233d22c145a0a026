"""A piece of a trajectory between two stops, and how it stands to the limits."""

from __future__ import annotations

from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

Array = NDArray[np.float64]


class Limits(NamedTuple):
    """What the joints can do, either way."""

    velocity: Array
    """Shape (dof,), in the joints' units per second."""
    acceleration: Array
    """Shape (dof,), in the joints' units per second squared."""


class Piece(NamedTuple):
    """Positions and velocities at some times, with cubic Hermite interpolation between them."""

    times: Array
    """Shape (N,), in seconds, increasing from 0."""
    positions: Array
    """Shape (N, dof)."""
    velocities: Array
    """Shape (N, dof)."""

    def slower(self, factor: float) -> Piece:
        """The same way in `factor` times the time."""
        return Piece(self.times * factor, self.positions, self.velocities / factor)

    def between(self, fractions: Array) -> Array:
        """The positions at some fractions (K,) of each step from one time to the next: (N - 1, K, dof)."""
        span = np.diff(self.times)[:, None, None]
        first, way = self.positions[:-1, None], np.diff(self.positions, axis=0)[:, None]
        begin, end = self.velocities[:-1, None] * span - way, self.velocities[1:, None] * span - way
        u = fractions[:, None]
        return np.asarray(first + u * (way + (1 - u) * ((1 - u) * begin - u * end)))

    def within(self, low: Array, high: Array) -> Piece:
        """The nearest such motion at the same times by which no joint ever leaves a range.

        A cubic stays in the hull of its four Bézier control points, of which positions and velocities at its ends tell.

        Args:
            low: The ends of the ranges, (dof,); the joints stand still inside of them at the first and the last time.
            high: The other ends.
        """
        positions = np.clip(self.positions, low, high)
        pace = 3 / np.diff(self.times)[:, None]
        to_low, to_high = low - positions, high - positions
        velocities = self.velocities.copy()
        velocities[:-1] = np.clip(velocities[:-1], pace * to_low[:-1], pace * to_high[:-1])
        velocities[1:] = np.clip(velocities[1:], -pace * to_high[1:], -pace * to_low[1:])
        return Piece(self.times, positions, velocities)

    def excess(self, limits: Limits) -> float:
        """By which factor the piece has to be slower to be within the limits everywhere; 1 or less if it is.

        Exact: the acceleration of a cubic is extreme at its ends, its velocity there or where the acceleration is 0.
        """
        span = np.diff(self.times)[:, None]
        chord = np.diff(self.positions, axis=0) / span
        begin, end = self.velocities[:-1] - chord, self.velocities[1:] - chord
        first, last = (-4 * begin - 2 * end) / span, (2 * begin + 4 * end) / span
        turns = first * last < 0
        u = np.divide(first, first - last, out=np.zeros_like(first), where=turns)
        turning = chord + (1 - u) * (1 - 3 * u) * begin + u * (3 * u - 2) * end  # the first velocity where u is 0
        velocity = (np.abs(np.concatenate([self.velocities, turning])) / limits.velocity).max()
        acceleration = (np.abs(np.concatenate([first, last])) / limits.acceleration).max()
        return float(max(velocity, np.sqrt(acceleration)))
