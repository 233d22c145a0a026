"""The polynomials that a controller follows between the points of a trajectory.

A joint trajectory controller that is given positions and velocities follows cubics; where it is given accelerations as
well, it follows quintics, which differ from the cubics wherever the acceleration jumps.
"""

from __future__ import annotations

from collections.abc import Sequence
from functools import cached_property
from math import comb

import numpy as np
from numpy.typing import NDArray

from llm3.types import Trajectory

Array = NDArray[np.float64]
SAME = 1e-6
"""By which share of the largest one accelerations may differ that are the same."""
TINY = 1e-9
"""By which share of the largest a coefficient of a polynomial may be left out."""


class Curves:
    """The polynomials of a trajectory with at least two points, one for each piece and joint."""

    def __init__(self, coefficients: Array, spans: Array) -> None:
        """Take coefficients by power of u, which goes from 0 to 1 in each piece.

        Args:
            coefficients: Shape (degree + 1, pieces, dof).
            spans: How long each piece takes, (pieces,), in seconds.
        """
        self._c, self._spans = coefficients, spans[:, None]

    @cached_property
    def derivatives(self) -> tuple[Array, Array, Array]:
        """Coefficients of positions, velocities and accelerations, (k, pieces, dof), in units and seconds."""
        velocities = _derivative(self._c) / self._spans
        return self._c, velocities, _derivative(velocities) / self._spans

    def positions(self, fractions: Array) -> Array:
        """Positions at some fractions (K,) of each piece: (K, pieces, dof)."""
        powers = fractions[:, None] ** np.arange(len(self._c))
        return np.asarray(np.tensordot(powers, self._c, axes=1))


def cubics(trajectory: Trajectory) -> Curves:
    """What is followed where positions and velocities are given."""
    spans, q, v = _rows(trajectory)
    begin, end, way = v[:-1] * spans[:, None], v[1:] * spans[:, None], np.diff(q, axis=0)
    return Curves(np.array([q[:-1], begin, 3 * way - 2 * begin - end, begin + end - 2 * way]), spans)


def quintics(trajectory: Trajectory) -> Curves:
    """What is followed where the `accelerations` are given as well."""
    spans, q, v = _rows(trajectory)
    h, a = spans[:, None], accelerations(trajectory)
    begin, end, way = v[:-1] * h, v[1:] * h, np.diff(q, axis=0)
    bend, last = a[:-1] * h**2, a[1:] * h**2
    # What is left for the powers from 3 on: position, velocity and acceleration at the end of the piece.
    p, s, c = way - begin - bend / 2, end - begin - bend, last - bend
    powers = [q[:-1], begin, bend / 2, 10 * p - 4 * s + c / 2, -15 * p + 7 * s - c, 6 * p - 3 * s + c / 2]
    return Curves(np.array(powers), spans)


def accelerations(trajectory: Trajectory) -> Array:
    """The acceleration at each point, (N, dof), in the joints' units per second squared.

    Between two points it is that of the cubic. Where two cubics meet and it jumps, it is the mean of both sides.
    """
    if len(trajectory.times) == 1:
        return np.zeros((1, len(trajectory.positions[0])))
    with np.errstate(all="ignore"):  # what was read may hold any number
        _, _, (first, slope) = cubics(trajectory).derivatives
        last = first + slope
        return np.concatenate([first[:1], (last[:-1] + first[1:]) / 2, last[-1:]])


def check_accelerations(trajectory: Trajectory, told: Sequence[Sequence[float]]) -> None:
    """See that accelerations, a row for each point, are those of the trajectory: nothing else is read of them.

    Raises:
        ValueError: They are not.
    """
    true, told_rows = accelerations(trajectory), np.array(told, dtype=float)
    with np.errstate(all="ignore"):
        most = np.abs(true).max(initial=1.0)
        wrong = ~(np.abs(true - told_rows) <= SAME * most)
    if wrong.any():
        point, joint = np.argwhere(wrong)[0]
        raise ValueError(
            f"the acceleration of joint value {joint} at point {point} of a trajectory is "
            f"{told_rows[point, joint]:.6g}, and its positions and velocities make it {true[point, joint]:.6g}"
        )


def largest(coefficients: Array, worth: Array) -> Array:
    """The largest magnitude that each polynomial (k, pieces, dof) has for u from 0 to 1: (pieces, dof).

    Exact, but where it is no more than `worth`, (dof,), anyway: there it may be a bound. A polynomial stays in the hull
    of its Bézier control points.
    """
    degree = len(coefficients) - 1
    share = np.array([[comb(i, k) / comb(degree, k) for k in range(degree + 1)] for i in range(degree + 1)])
    bound = np.asarray(np.abs(np.tensordot(share, coefficients, axes=1)).max(axis=0))
    bound = np.where(np.isfinite(bound), bound, np.inf)
    for piece, joint in np.argwhere(np.isfinite(bound) & (bound > worth)):
        bound[piece, joint] = abs(extreme(coefficients[:, piece, joint])[1])
    return bound


def extreme(coefficients: Array) -> tuple[float, float]:
    """Where for u from 0 to 1 a polynomial, finite numbers (k,), has the largest magnitude, and its value there."""
    slope = _derivative(coefficients)
    slope[np.abs(slope) < TINY * np.abs(slope).max()] = 0.0  # a tiny leading coefficient would spoil all roots
    turns = np.roots(slope[::-1]).real
    at = np.concatenate([[0.0, 1.0], turns[(turns > 0) & (turns < 1)]])
    values = np.polyval(coefficients[::-1], at)
    most = int(np.abs(values).argmax())
    return float(at[most]), float(values[most])


def _derivative(c: Array) -> Array:
    return np.asarray((c[1:].T * np.arange(1, len(c))).T)


def _rows(trajectory: Trajectory) -> tuple[Array, Array, Array]:
    return np.diff(trajectory.times), np.array(trajectory.positions), np.array(trajectory.velocities)
