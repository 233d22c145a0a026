"""Messages of ROS 2, field by field in their own order; docs/export.md says what the fields mean here."""

from __future__ import annotations

from dataclasses import dataclass, field

SECOND = 10**9
"""In nanoseconds."""


@dataclass(frozen=True)
class Duration:
    """``builtin_interfaces/msg/Duration``, and ``Time`` likewise."""

    sec: int = 0
    nanosec: int = 0

    def __post_init__(self) -> None:
        if not 0 <= self.sec < 2**31 or not 0 <= self.nanosec < SECOND:
            raise ValueError(f"no time has {self.sec} s and {self.nanosec} ns")


@dataclass(frozen=True)
class Header:
    """``std_msgs/msg/Header``: a time of 0 means at once."""

    stamp: Duration = field(default=Duration())
    frame_id: str = ""


@dataclass(frozen=True)
class JointTrajectoryPoint:
    """``trajectory_msgs/msg/JointTrajectoryPoint``."""

    positions: tuple[float, ...]
    velocities: tuple[float, ...]
    accelerations: tuple[float, ...]
    effort: tuple[float, ...]
    time_from_start: Duration


@dataclass(frozen=True)
class JointTrajectory:
    """``trajectory_msgs/msg/JointTrajectory``."""

    header: Header
    joint_names: tuple[str, ...]
    points: tuple[JointTrajectoryPoint, ...]


@dataclass(frozen=True)
class GripperCommand:
    """``control_msgs/msg/GripperCommand``."""

    position: float
    max_effort: float = 0.0


@dataclass(frozen=True)
class Goal:
    """The goal of ``control_msgs/action/GripperCommand``."""

    command: GripperCommand
