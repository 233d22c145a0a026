"""A robot as data: what its URDF file does not say."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field

from llm3.types import FrozenDict, Pose

_ORIGIN = Pose((0.0, 0.0, 0.0))


@dataclass(frozen=True, kw_only=True)
class ParallelGripper:
    """Two fingers that move symmetrically."""

    joints: tuple[str, ...]
    """The finger joints (prismatic, metres); each moves by half of the opening."""
    links: tuple[str, ...]
    """Hand and fingers: their contacts are reported as the gripper's, and they may touch what is held."""
    max_opening: float
    """Largest distance between the fingers in metres."""
    finger_reach: float
    """How far a finger stands out beyond the face that it grips, along the closing direction, in metres."""
    closing_axis: tuple[float, float, float]
    """Unit vector in the tool frame along which the fingers close."""
    palm_height: float
    """Distance from the tool point back to the palm, in metres."""


@dataclass(frozen=True, kw_only=True)
class SuctionGripper:
    """A cup that holds a box by its upper face. The tool point is the middle of the cup's rim."""

    links: tuple[str, ...]
    """Tube and cup: their contacts are reported as the gripper's, and they may touch what is held."""
    cup_radius: float
    """Radius of the rim in metres: the face must be wider than the rim."""

    @property
    def joints(self) -> tuple[str, ...]:
        """None: nothing moves."""
        return ()

    @property
    def max_opening(self) -> float:
        """0: nothing opens."""
        return 0.0


Gripper = ParallelGripper | SuctionGripper


@dataclass(frozen=True, kw_only=True)
class Attachment:
    """Something with a URDF file of its own that is fixed to a link of the robot, such as a tool or a pedestal."""

    urdf: str
    """Its file, as `RobotDescription.urdf`."""
    link: str
    """The robot's link that it is fixed to, such as the flange."""
    pose: Pose = _ORIGIN
    """Of its base link, in that link's frame."""


@dataclass(frozen=True, kw_only=True)
class RobotDescription:
    """Everything about a robot that is not in its URDF file, and what overrides it."""

    name: str
    urdf: str
    """Its file: a path, or ``package://NAME/PATH`` for a file inside an installed Python package."""
    arm_joints: tuple[str, ...]
    """The joints from the base to the tool, in order."""
    tool_link: str
    """The link that carries the tool frame; its z axis points out of the hand, its origin is the tool centre point."""
    home: tuple[float, ...]
    """A configuration of the arm, in radians, in which it stands free."""
    fingers: ParallelGripper | None = None
    suction: SuctionGripper | None = None
    """What it holds things with: one of the two."""
    base: Pose = _ORIGIN
    """Of the robot's base link, in the world frame."""
    attachments: tuple[Attachment, ...] = ()
    """What the robot's own URDF file lacks."""
    joint_limits: Mapping[str, tuple[float, float]] = field(default_factory=FrozenDict)
    """Limits in radians that replace the URDF's, by joint name."""
    max_velocity: Mapping[str, float] = field(default_factory=FrozenDict)
    """Speeds in rad/s that replace the URDF's, by joint name."""
    max_acceleration: Mapping[str, float] = field(default_factory=FrozenDict)
    """Accelerations in rad/s², by joint name; URDF has none. Joints without one cannot be timed."""
    may_touch: tuple[tuple[str, str], ...] = ()
    """Pairs of links that always touch and are never counted as a collision."""
    mounted_links: tuple[str, ...] = ()
    """Links that stand on the table and may touch what they stand on."""
    source: str = ""
    """Where the figures come from."""

    def __post_init__(self) -> None:
        for name in ("joint_limits", "max_velocity", "max_acceleration"):
            object.__setattr__(self, name, FrozenDict(getattr(self, name)))
        if (self.fingers is None) == (self.suction is None):
            raise ValueError(f"robot {self.name!r} needs fingers or suction, one of the two")

    @property
    def gripper(self) -> Gripper:
        """What it holds things with."""
        gripper = self.fingers or self.suction
        assert gripper  # noqa: S101  # __post_init__ has seen to it
        return gripper
