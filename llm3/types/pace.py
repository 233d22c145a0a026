"""When the robot is where on a piece of motion, also where the plan has no times."""

from __future__ import annotations

from functools import cached_property

import numpy as np
from numpy.typing import ArrayLike, NDArray

from llm3.types.motion import Segment

PACE = 1.0
"""How fast the fastest joint moves where a plan has no times: in radians, or metres, per second."""


class Timed:
    """A piece of motion in time: its trajectory or, where it has none, straight lines at `PACE`."""

    def __init__(self, segment: Segment) -> None:
        """Take the piece."""
        self._trajectory, self._waypoints = segment.trajectory, np.array(segment.waypoints, dtype=float)

    @property
    def duration(self) -> float:
        """How long it takes, in seconds."""
        return self._trajectory.duration if self._trajectory else float(self._knots[-1])

    def positions(self, times: ArrayLike) -> NDArray[np.float64]:
        """The configurations (N, dof) at some times (N,), in seconds from the start of the piece."""
        if self._trajectory:
            return self._trajectory.sample(times)[0]
        return np.column_stack([np.interp(np.asarray(times), self._knots, joint) for joint in self._waypoints.T])

    @cached_property
    def _knots(self) -> NDArray[np.float64]:
        """When the robot is at each waypoint, in seconds."""
        ways = np.abs(np.diff(self._waypoints, axis=0)).max(axis=1, initial=0.0) / PACE
        return np.concatenate([[0.0], np.cumsum(ways)])
