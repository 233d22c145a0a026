"""Times for paths."""

from __future__ import annotations

from abc import ABC, abstractmethod

from llm3.types import Trajectory, Vector


class TrajectoryTimer(ABC):
    """Turns a path into a trajectory: when the robot is where, within what its joints can do."""

    @abstractmethod
    def time(self, waypoints: Vector, max_velocity: Vector, max_acceleration: Vector) -> Trajectory:
        """Put times to a path.

        The path between the waypoints was checked for collision, so a timer may leave it by no more than what is
        small against the distance that planners keep from obstacles. No joint may leave the range that it has at the
        waypoints: what lies beyond may be past the end of its travel.

        Args:
            waypoints: Shape (N, dof), N at least 1, joined by straight lines in joint space. Some may repeat.
            max_velocity: Of each joint either way, (dof,), in its unit per second.
            max_acceleration: Of each joint either way, (dof,), in its unit per second squared.

        Returns:
            A trajectory from standstill at the first waypoint through all others to standstill at the last, within
            the limits at all times. The same arguments give the same trajectory.
        """
