"""Timers with one fault each."""

from __future__ import annotations

from itertools import count, pairwise

import numpy as np
from planted import Planted

from llm3 import TrajectoryTimer
from llm3.types import Trajectory


class Steady(TrajectoryTimer):
    """Stops at every waypoint; between two of them one cubic, in time enough for all limits."""

    hurry = 1.0

    def time(self, waypoints, max_velocity, max_acceleration):
        kept = self.kept(waypoints)
        times = [0.0]
        for a, b in pairwise(kept):
            way = abs(b - a)
            # A cubic between standstills is fastest in its middle, 1.5 way / time, and brakes hardest at its ends.
            needed = max((1.5 * way / max_velocity).max(), np.sqrt(6 * way / max_acceleration).max())
            times.append(times[-1] + needed / self.hurry)
        return self.told(Trajectory(tuple(times), tuple(map(tuple, kept)), tuple(map(tuple, np.zeros_like(kept)))))

    def kept(self, waypoints):
        moved = np.abs(np.diff(waypoints, axis=0)).max(axis=1) > 0
        return waypoints[np.concatenate([[True], moved])]

    def told(self, trajectory):
        return trajectory


def a_timer(**parts):
    return type("Timer", (Steady,), parts)()


def late():
    """Each trajectory is slower than the one before."""
    calls = count(1)

    def told(self, t):
        slower = next(calls)
        return Trajectory(tuple(slower * time for time in t.times), t.positions, t.velocities)

    return told


def bulging(self, t):
    """With a velocity at the first corner that swings the motion out."""
    velocities = [list(v) for v in t.velocities]
    if len(velocities) > 2:
        velocities[1] = [1.0] * len(velocities[1])
    return Trajectory(t.times, t.positions, velocities)


FAULTS: dict[str, Planted] = {
    "no trajectory": Planted(
        a_timer(told=lambda self, t: t.times),
        "answers are trajectories",
        "one waypoint: time answers (0.0,).",
        "a Trajectory",
    ),
    "does not arrive": Planted(
        a_timer(told=lambda self, t: Trajectory(t.times[:1], t.positions[:1], t.velocities[:1])),
        "motions begin and end at rest",
        "a line: the motion ends at (0), and not at (1).",
        "the ends of the path",
    ),
    "does not stop": Planted(
        a_timer(
            told=lambda self, t: Trajectory(t.times, t.positions, (*t.velocities[:-1], [0.5] * len(t.positions[0])))
        ),
        "motions begin and end at rest",
        "one waypoint: the motion begins with a velocity of (0.5, 0.5).",
        "standstill",
    ),
    "cuts corners": Planted(
        a_timer(
            kept=lambda self, waypoints: (
                waypoints[[0, -1]] if waypoints[-1].tolist() == [1, 1] else Steady.kept(self, waypoints)
            )
        ),
        "motions pass through every waypoint",
        "a corner: the motion does not pass through (1, 0).",
        "do not cut corners",
    ),
    "swings out": Planted(
        a_timer(told=bulging),
        "motions pass through every waypoint",
        "…: the motion leaves the lines between the waypoints by ….",
        "swings out",
    ),
    "too fast": Planted(
        a_timer(hurry=1.5),
        "motions stay within the limits",
        "a line: the velocity reaches 1.3 times what the joint may.",
        "between the times",
    ),
    "slower each time": Planted(
        a_timer(told=late()),
        "the same path gives the same times",
        "…: the same path gets two trajectories.",
        "draws nothing",
    ),
    "changes its path": Planted(
        a_timer(kept=lambda self, waypoints: Steady.kept(self, np.add(waypoints, 1.0, out=waypoints))),
        "the same path gives the same times",
        "one waypoint: time changes the waypoints that it is given.",
        "copy",
    ),
}
