"""The polynomials that a trajectory follows."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from llm3.types import Trajectory
from llm3_bullet.poses import Array


@dataclass(frozen=True, eq=False)
class Curves:
    """The polynomials of a trajectory: q(u) = c0 + c1 u + c2 u² + c3 u³ for u from 0 to 1, each (pieces, dof)."""

    begins: Array
    """When each begins, (pieces,), in seconds."""
    spans: Array
    """How long each takes, (pieces,), in seconds."""
    coefficients: tuple[Array, Array, Array, Array]

    def positions(self, u: Array) -> Array:
        """Where the joints are, (pieces, dof), at u from 0 to 1 in each piece."""
        c0, c1, c2, c3 = self.coefficients
        return np.asarray(c0 + u * (c1 + u * (c2 + u * c3)))

    def speeds(self, u: Array) -> Array:
        """How fast they move, in rad/s or m/s."""
        _, c1, c2, c3 = self.coefficients
        return np.asarray(np.abs(c1 + u * (2 * c2 + 3 * u * c3)) / self.spans[:, None])

    def accelerations(self, u: Array) -> Array:
        """How hard they accelerate, in rad/s² or m/s²."""
        _, _, c2, c3 = self.coefficients
        return np.asarray(np.abs(2 * c2 + 6 * u * c3) / self.spans[:, None] ** 2)

    def turning_points(self) -> tuple[Array, ...]:
        """Where positions and speeds may be extreme: the ends, and where the first or second derivative is 0."""
        _, c1, c2, c3 = self.coefficients
        with np.errstate(divide="ignore", invalid="ignore"):
            root = np.sqrt(c2 * c2 - 3 * c1 * c3)
            inner = ((-c2 + root) / (3 * c3), (-c2 - root) / (3 * c3), -c1 / (2 * c2), -c2 / (3 * c3))
        bounded = (np.clip(np.nan_to_num(u), 0.0, 1.0) for u in inner)
        return np.zeros_like(c1), np.ones_like(c1), *bounded


def curves_of(trajectory: Trajectory) -> Curves:
    """The cubic polynomials between a trajectory's times."""
    times, q, v = (np.array(rows) for rows in (trajectory.times, trajectory.positions, trajectory.velocities))
    spans = np.diff(times)
    c0, c1, end = q[:-1], v[:-1] * spans[:, None], v[1:] * spans[:, None]
    way = q[1:] - c0
    return Curves(times[:-1], spans, (c0, c1, 3 * way - 2 * c1 - end, c1 + end - 2 * way))
