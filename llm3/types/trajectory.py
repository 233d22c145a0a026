"""A piece of motion in time."""

from __future__ import annotations

from dataclasses import dataclass
from itertools import pairwise

import numpy as np
from numpy.typing import ArrayLike, NDArray

from llm3.types.checks import finite


@dataclass(frozen=True)
class Trajectory:
    """Where the robot is at any time, and how fast it moves.

    Between two of the times every joint follows the cubic polynomial that has the positions and the velocities of both
    (cubic Hermite interpolation), as joint trajectory controllers do.
    """

    times: tuple[float, ...]
    """In seconds from the start of the piece: the first is 0, and each is later than the one before it."""
    positions: tuple[tuple[float, ...], ...]
    """The configuration at each time."""
    velocities: tuple[tuple[float, ...], ...]
    """The velocity of each joint at each time, in its unit per second."""

    def __post_init__(self) -> None:
        times = finite("a trajectory's times", self.times)
        if not times or times[0] != 0 or any(b <= a for a, b in pairwise(times)):
            raise ValueError(f"a trajectory's times must begin with 0 and increase, and {times} do not")
        object.__setattr__(self, "times", times)
        dof = len(self.positions[0]) if self.positions else 0
        for name in ("positions", "velocities"):
            rows = tuple(finite(f"a trajectory's {name}", row) for row in getattr(self, name))
            if len(rows) != len(times) or any(len(row) != dof for row in rows):
                raise ValueError(f"a trajectory's {name} must be {dof} numbers at each of its {len(times)} times")
            object.__setattr__(self, name, rows)

    @property
    def duration(self) -> float:
        """How long it takes, in seconds."""
        return self.times[-1]

    def sample(self, times: ArrayLike) -> tuple[NDArray[np.float64], NDArray[np.float64], NDArray[np.float64]]:
        """What the robot does at some times.

        Args:
            times: Shape (N,), in seconds. Before the first time of the trajectory and after its last it stands.

        Returns:
            Positions, velocities and accelerations, each (N, dof). Where two polynomials meet, the acceleration is
            that of the later one.
        """
        at = np.asarray(times, dtype=float)
        knots, positions, velocities = np.array(self.times), np.array(self.positions), np.array(self.velocities)
        if len(knots) == 1:
            still = np.zeros((len(at), positions.shape[1]))
            return positions[0] + still, still, still.copy()
        index = np.clip(np.searchsorted(knots, at, side="right") - 1, 0, len(knots) - 2)
        span = np.diff(knots)[index, None]
        u = np.clip((at - knots[index])[:, None] / span, 0.0, 1.0)  # 0 to 1 within a polynomial
        chord = (positions[index + 1] - positions[index]) / span
        begin, end = velocities[index] - chord, velocities[index + 1] - chord
        q = positions[index] + span * u * (chord + (1 - u) * ((1 - u) * begin - u * end))
        v = chord + (1 - u) * (1 - 3 * u) * begin + u * (3 * u - 2) * end
        a = ((6 * u - 4) * begin + (6 * u - 2) * end) / span
        moving = ((at >= 0) & (at <= self.duration))[:, None]
        return q, v * moving, a * moving
