"""The timer: stops at corners, and is as fast as the limits allow between them."""

from __future__ import annotations

from collections.abc import Iterator

import numpy as np

from llm3.interfaces import TrajectoryTimer
from llm3.types import Trajectory
from llm3_time.curved import curved
from llm3_time.piece import Array, Limits, Piece
from llm3_time.straight import straight

CORNER = np.radians(10.0)
"""Where the direction in joint space changes by more, the robot stops."""
SHARE = 0.999
"""How much of the limits is used: the rest is for the rounding of numbers."""
DIGITS = 9
"""Velocities are rounded to that many significant digits, which keeps plans short."""


class ToppraTimer(TrajectoryTimer):
    """Follows the edges between the waypoints, with stops at corners.

    A motion through waypoints between two corners, such as a straight line of the tool, becomes a smooth curve that
    stays within `llm3_time.curved.TOLERANCE` of the edges, and each joint between its least and its largest position
    at these waypoints. Where that cannot be, the robot stops in between, at last
    at every waypoint, which is always possible and exact.
    """

    def time(self, waypoints: Array, max_velocity: Array, max_acceleration: Array) -> Trajectory:
        """Put times to a path; see `TrajectoryTimer.time`."""
        limits = Limits(max_velocity * SHARE, max_acceleration * SHARE)
        moved = np.linalg.norm(np.diff(waypoints, axis=0), axis=1) > 0
        pieces = list(_pieces(waypoints[np.concatenate([[True], moved])], limits))
        starts = np.cumsum([0.0, *(piece.times[-1] for piece in pieces)])
        times = [piece.times[1:] + start for piece, start in zip(pieces, starts, strict=False)]
        positions = [piece.positions[1:] for piece in pieces]
        velocities = [piece.velocities[1:] for piece in pieces]
        return Trajectory(
            tuple(np.concatenate([[0.0], *times]).tolist()),
            tuple(map(tuple, np.concatenate([waypoints[:1], *positions]).tolist())),
            tuple(map(_rounded, np.concatenate([np.zeros_like(waypoints[:1]), *velocities]).tolist())),
        )


def _pieces(waypoints: Array, limits: Limits) -> Iterator[Piece]:
    """The motions from stop to stop, in order; stops are at corners, the sharpest first, and where no curve fits."""
    left = [waypoints]
    while left:
        run = left.pop()
        if len(run) == 2:
            yield straight(run[0], run[1], limits)
        elif len(run) > 2:
            turns = _turns(run)
            piece = curved(run, limits) if turns.max() <= CORNER else None
            if piece:
                yield piece.slower(max(1.0, piece.excess(limits)))
            else:
                sharpest = int(turns.argmax()) + 1
                left += [run[sharpest:], run[: sharpest + 1]]


def _turns(waypoints: Array) -> Array:
    """By which angle the direction in joint space changes at each waypoint but the ends, (N - 2,), in radians."""
    ways = np.diff(waypoints, axis=0)
    ways /= np.linalg.norm(ways, axis=1, keepdims=True)
    apart, along = (np.linalg.norm(sides, axis=1) for sides in (ways[1:] - ways[:-1], ways[1:] + ways[:-1]))
    return np.asarray(2 * np.arctan2(apart, along))  # exact for small angles, which the arc cosine is not


def _rounded(values: list[float]) -> tuple[float, ...]:
    return tuple(float(f"{value:.{DIGITS}g}") + 0.0 for value in values)
