"""A robot as data: what its URDF file does not say."""

from __future__ import annotations

import math
from collections.abc import Mapping
from dataclasses import dataclass, field

from llm3.types import FrozenDict, Pose

_ORIGIN = Pose((0.0, 0.0, 0.0))
_LARGEST = 1000.0
"""Metres, radians, or those per second or second squared: more than that is a mistake."""
_PERPENDICULAR = 1e-3


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
    tip_depth: float = 0.0
    """How far the fingers' tips are beyond the tool point, in metres."""
    finger_width: float | None = None
    """Of a finger across the closing direction, in metres; None if it is not known."""
    palm_size: tuple[float, float] | None = None
    """Of the palm, with the fingers under its middle, in metres: along the closing direction, and across. Like the
    width of a finger it is only told to models; None if it is not known."""

    def __post_init__(self) -> None:
        if len(self.joints) != 2:
            raise ValueError(f"fingers need two joints, not {len(self.joints)}")
        if not self.links:
            raise ValueError("the links of the fingers must name the hand and the fingers")
        _positive("max_opening", self.max_opening)
        for name in ("finger_reach", "palm_height", "tip_depth"):
            if not 0 <= getattr(self, name) <= _LARGEST:
                raise ValueError(f"{name} must be a length of 0 or more, in metres, not {getattr(self, name):g}")
        for name, lengths in (("finger_width", (self.finger_width,)), ("palm_size", self.palm_size or ())):
            for length in lengths:
                if length is not None:
                    _positive(name, length)
        along, length = self.closing_axis[-1], math.hypot(*self.closing_axis)
        if abs(length - 1) > _PERPENDICULAR or abs(along) > _PERPENDICULAR:
            raise ValueError(
                f"closing_axis must be a unit vector across the tool's z axis, such as [0.0, 1.0, 0.0], not "
                f"{list(self.closing_axis)}"
            )


@dataclass(frozen=True, kw_only=True)
class SuctionGripper:
    """A cup that holds a box by its upper face. The tool point is the middle of the cup's rim."""

    links: tuple[str, ...]
    """Tube and cup: their contacts are reported as the gripper's, and they may touch what is held."""
    cup_radius: float
    """Radius of the rim in metres: the face must be wider than the rim."""

    def __post_init__(self) -> None:
        if not self.links:
            raise ValueError("the links of the suction must name the cup")
        _positive("cup_radius", self.cup_radius)

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

    def __post_init__(self) -> None:
        _near("the pose of an attachment", self.pose)


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
    """A configuration of the arm in which it stands free, in radians (metres where a joint slides)."""
    fingers: ParallelGripper | None = None
    suction: SuctionGripper | None = None
    """What it holds things with: one of the two."""
    base: Pose = _ORIGIN
    """Of the robot's base link, in the world frame."""
    attachments: tuple[Attachment, ...] = ()
    """What the robot's own URDF file lacks."""
    joint_limits: Mapping[str, tuple[float, float]] = field(default_factory=FrozenDict)
    """Limits in radians (metres) that replace the URDF's, by joint name."""
    max_velocity: Mapping[str, float] = field(default_factory=FrozenDict)
    """Speeds in rad/s (m/s) that replace the URDF's, by joint name."""
    max_acceleration: Mapping[str, float] = field(default_factory=FrozenDict)
    """Accelerations in rad/s² (m/s²), by joint name; URDF has none. Joints without one cannot be timed."""
    may_touch: tuple[tuple[str, str], ...] = ()
    """Pairs of links that always touch and are never counted as a collision."""
    mounted_links: tuple[str, ...] = ()
    """Links that stand on the table and may touch what they stand on."""
    reach_from_above: tuple[float, float] | None = None
    """Between which distances from the base, in metres, what stands on a table at the base's height is surely within
    reach of a tool that points straight down, however it is turned; None if it is not known. It is only told to
    models."""
    source: str = ""
    """Where the figures come from."""

    def __post_init__(self) -> None:
        for name in ("joint_limits", "max_velocity", "max_acceleration"):
            object.__setattr__(self, name, FrozenDict(getattr(self, name)))
        for name in ("max_velocity", "max_acceleration"):
            for joint, value in getattr(self, name).items():
                _positive(f"{name} of {joint!r}", value)
        for joint, limits in self.joint_limits.items():
            if not -_LARGEST <= limits[0] < limits[1] <= _LARGEST:
                raise ValueError(f"joint_limits of {joint!r} must be a lower and a higher number, not {list(limits)}")
        if self.reach_from_above and not 0 <= self.reach_from_above[0] < self.reach_from_above[1] <= _LARGEST:
            raise ValueError(
                "reach_from_above must be a shorter and a longer distance, in metres, not "
                f"{list(self.reach_from_above)}"
            )
        if not self.urdf:
            raise ValueError("urdf must name a file")
        _near("the base", self.base)
        if (self.fingers is None) == (self.suction is None):
            raise ValueError(f"robot {self.name!r} needs fingers or suction, one of the two")

    @property
    def gripper(self) -> Gripper:
        """What it holds things with."""
        gripper = self.fingers or self.suction
        assert gripper  # noqa: S101  # __post_init__ has seen to it
        return gripper


def _positive(what: str, value: float) -> None:
    if not 0 < value <= _LARGEST:
        raise ValueError(f"{what} must be more than 0 and at most {_LARGEST:g}, not {value:g}")


def _near(what: str, pose: Pose) -> None:
    if max(map(abs, pose.position)) > _LARGEST:
        raise ValueError(f"{what} must be within {_LARGEST:g} m, not at {list(pose.position)}")
