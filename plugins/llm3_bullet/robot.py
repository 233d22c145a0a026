"""A robot as data: what its URDF file does not say."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field
from pathlib import Path

from llm3.types import FrozenDict


@dataclass(frozen=True)
class ParallelGripper:
    """Two fingers that move symmetrically."""

    joints: tuple[str, ...]
    """The finger joints (prismatic, metres); each moves by half of the opening."""
    links: tuple[str, ...]
    """Hand and fingers: their contacts are reported as the gripper's."""
    max_opening: float
    """Largest distance between the fingers in metres."""
    finger_reach: float
    """How far a finger stands out beyond the face that it grips, along the closing direction, in metres."""
    closing_axis: tuple[float, float, float]
    """Unit vector in the tool frame along which the fingers close."""
    palm_height: float
    """Distance from the tool point back to the palm, in metres."""


@dataclass(frozen=True)
class RobotDescription:
    """Everything about a robot that is not in its URDF file, and what overrides it."""

    name: str
    urdf: Path
    arm_joints: tuple[str, ...]
    tool_link: str
    """The link that carries the tool frame; its z axis points out of the hand, its origin is the tool centre point."""
    home: tuple[float, ...]
    """A configuration of the arm, in radians, in which it stands free."""
    gripper: ParallelGripper
    joint_limits: Mapping[str, tuple[float, float]] = field(default_factory=FrozenDict)
    """Limits in radians that replace the URDF's, by joint name."""
    may_touch: tuple[tuple[str, str], ...] = ()
    """Pairs of links that always touch and are never counted as a collision."""
    mounted_links: tuple[str, ...] = ()
    """Links that stand on the table and may touch what they stand on."""
    source: str = ""
    """Where the figures come from."""
