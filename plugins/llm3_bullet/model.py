"""A robot's structure: its description together with its URDF file."""

from __future__ import annotations

from functools import cached_property

import numpy as np
from numpy.typing import NDArray

from llm3.errors import InputError
from llm3_bullet.mounting import urdf_file
from llm3_bullet.robot import RobotDescription
from llm3_bullet.urdf import Urdf, UrdfJoint, read_urdf


class RobotModel:
    """Links, joints and limits of a robot.

    Links are numbered with the base at 0 and then as PyBullet counts them: link i here is link i - 1 there, and
    the joint that carries it has PyBullet's number i - 1 too.
    """

    description: RobotDescription
    links: tuple[str, ...]
    """All link names, the base first."""
    joints: tuple[UrdfJoint, ...]
    """All joints, moving or not; the joint at position i carries the link at position i + 1."""
    parents: tuple[int, ...]
    """For each link the number of the link that it hangs on; -1 for the base."""
    low: NDArray[np.float64]
    """(dof,): lower limits of the arm's joints, in radians (metres where a joint slides)."""
    high: NDArray[np.float64]
    """(dof,): upper limits."""
    home: NDArray[np.float64]
    """(dof,): the description's home configuration."""
    max_velocity: tuple[float | None, ...]
    """(dof,): greatest speeds in rad/s (m/s where a joint slides); None where neither file nor description has one."""
    max_acceleration: tuple[float | None, ...]
    """(dof,): greatest accelerations in rad/s² (m/s²); None where the description has none."""

    def __init__(self, description: RobotDescription) -> None:
        """Read the URDF file and lay the description over it.

        Raises:
            InputError: The file is no good URDF, or the description does not fit it.
        """
        self.description = description
        with urdf_file(description) as file:
            urdf = read_urdf(file)
        self.links, self.joints = urdf.links, urdf.joints
        self.parents = (-1, *(self.links.index(joint.parent) for joint in self.joints))
        _check(description, urdf)
        limits = np.array([self._limits(name) for name in description.arm_joints], dtype=float)
        self.low, self.high = limits.T
        self.home = np.array(description.home, dtype=float)
        self.max_velocity = tuple(
            description.max_velocity.get(name, self.joints[self.joint(name)].max_velocity)
            for name in description.arm_joints
        )
        self.max_acceleration = tuple(description.max_acceleration.get(name) for name in description.arm_joints)
        for array in (self.low, self.high, self.home):
            array.setflags(write=False)
        if not self.within_limits(self.home[None])[0]:
            raise InputError(
                f"robot {description.name!r}: home {list(description.home)} is outside of the joint limits, "
                f"{self.low.tolist()} to {self.high.tolist()}."
            )

    @property
    def dof(self) -> int:
        """The number of the arm's joints."""
        return len(self.low)

    @cached_property
    def tool(self) -> int:
        """The number of the link that carries the tool frame."""
        return self.link(self.description.tool_link)

    @cached_property
    def arm_joints(self) -> tuple[int, ...]:
        """PyBullet's numbers of the arm's joints, in the order of a configuration."""
        return tuple(self.joint(name) for name in self.description.arm_joints)

    @cached_property
    def finger_joints(self) -> tuple[int, ...]:
        """PyBullet's numbers of the finger joints."""
        return tuple(self.joint(name) for name in self.description.gripper.joints)

    def link(self, name: str) -> int:
        """The number of a link, the base being 0; PyBullet's number is one less.

        Raises:
            InputError: There is no link of this name.
        """
        return _position(self.description, "link", name, self.links)

    def joint(self, name: str) -> int:
        """PyBullet's number of a joint.

        Raises:
            InputError: There is no joint of this name.
        """
        return _position(self.description, "joint", name, tuple(joint.name for joint in self.joints))

    def within_limits(self, Q: NDArray[np.float64], tolerance: float = 1e-9) -> NDArray[np.bool_]:
        """Which configurations (N, dof) respect the joint limits: (N,)."""
        inside = (self.low - tolerance <= Q) & (self.high + tolerance >= Q)
        return np.asarray(inside.all(axis=1))

    def _limits(self, name: str) -> tuple[float, float]:
        limits = self.description.joint_limits.get(name, self.joints[self.joint(name)].limits)
        if limits is None or not limits[0] < limits[1]:
            raise InputError(
                f"robot {self.description.name!r}: arm joint {name!r} has the limits {limits}, but needs a "
                "lower and a higher number; joint_limits of its description can give them."
            )
        return limits


def _check(description: RobotDescription, urdf: Urdf) -> None:
    """See that all names exist and that the arm is one chain from the base to the tool."""
    joints = tuple(joint.name for joint in urdf.joints)
    gripper = description.gripper
    limited = (*description.joint_limits, *description.max_velocity, *description.max_acceleration)
    for name in (*description.arm_joints, *gripper.joints, *limited):
        _position(description, "joint", name, joints)
    pairs = (name for pair in description.may_touch for name in pair)
    for name in (description.tool_link, *gripper.links, *description.mounted_links, *pairs):
        _position(description, "link", name, urdf.links)
    for name in gripper.joints:
        kind = urdf.joints[joints.index(name)].type
        if kind != "prismatic":
            raise InputError(f"robot {description.name!r}: finger joint {name!r} is {kind}, but must be prismatic.")
    carrier = {joint.child: joint for joint in urdf.joints}
    chain, link = [], description.tool_link
    while link in carrier:
        chain.append(carrier[link].name)
        link = carrier[link].parent
    moving = [name for name in reversed(chain) if urdf.joints[joints.index(name)].type != "fixed"]
    if moving != list(description.arm_joints):
        raise InputError(
            f"robot {description.name!r}: the moving joints from the base to {description.tool_link!r} are "
            f"{', '.join(moving) or 'none'}, but arm_joints are {', '.join(description.arm_joints) or 'none'}."
        )
    if len(description.home) != len(moving):
        raise InputError(
            f"robot {description.name!r}: home has {len(description.home)} values, "
            f"but there are {len(moving)} arm joints."
        )


def _position(description: RobotDescription, kind: str, name: str, known: tuple[str, ...]) -> int:
    if name not in known:
        raise InputError(
            f"robot {description.name!r}: {description.urdf} has no {kind} {name!r}; known are {', '.join(known)}."
        )
    return known.index(name)
