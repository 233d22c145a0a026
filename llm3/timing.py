"""Times for the motions of a plan."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace

import numpy as np

from llm3.errors import PluginError
from llm3.guarded import guarded
from llm3.interfaces import Joint, TrajectoryTimer
from llm3.types import PlannedAction, Segment, Trajectory, Vector


def timed(plan: Sequence[PlannedAction], timer: TrajectoryTimer, joints: Sequence[Joint]) -> tuple[PlannedAction, ...]:
    """The plan with a trajectory for every segment; as it was, where a limit of a joint is not known.

    Raises:
        PluginError: The timer failed, or its trajectory does not lead from the first waypoint to the last.
    """
    if unknown_limits(joints):
        return tuple(plan)
    velocity = np.array([joint.max_velocity for joint in joints], dtype=float)
    acceleration = np.array([joint.max_acceleration for joint in joints], dtype=float)

    def with_times(segment: Segment) -> Segment:
        waypoints = np.array(segment.waypoints, dtype=float)
        return replace(segment, trajectory=_trajectory(timer, waypoints, velocity, acceleration))

    return tuple(
        replace(step, motion=replace(step.motion, segments=tuple(map(with_times, step.motion.segments))))
        for step in plan
    )


def unknown_limits(joints: Sequence[Joint]) -> str:
    """Which limits a timer would need and the domain does not give, as a phrase; empty if it gives all."""
    if not joints:
        return "the domain names no joints"
    lacking = []
    for name in ("max_velocity", "max_acceleration"):
        without = [joint.name for joint in joints if getattr(joint, name) is None]
        if without:
            lacking.append(f"no {name} of {', '.join(without)}")
    return f"the domain gives {' and '.join(lacking)}" if lacking else ""


def _trajectory(timer: TrajectoryTimer, waypoints: Vector, velocity: Vector, acceleration: Vector) -> Trajectory:
    found = guarded(timer.time, (Trajectory,), waypoints, velocity, acceleration)
    ends = (np.array(found.positions[0]), waypoints[0]), (np.array(found.positions[-1]), waypoints[-1])
    if not all(here.shape == there.shape and np.allclose(here, there, atol=1e-9) for here, there in ends):
        owner = type(timer).__name__
        raise PluginError(f"{owner}.time must answer a trajectory from the first waypoint to the last.")
    return found
