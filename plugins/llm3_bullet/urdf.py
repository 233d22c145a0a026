"""Reads the tree of links and joints from a URDF file, without a simulator.

The format: https://wiki.ros.org/urdf/XML/joint. Shapes, masses and all else that is no kinematics is left out.
"""

from __future__ import annotations

import math
from dataclasses import dataclass
from pathlib import Path
from xml.etree import ElementTree as ET

import numpy as np
from numpy.typing import NDArray

from llm3.errors import InputError

JOINT_TYPES = ("continuous", "fixed", "prismatic", "revolute")


@dataclass(frozen=True, eq=False)
class UrdfJoint:
    """A joint: how the child link moves against the parent link."""

    name: str
    type: str
    """One of `JOINT_TYPES`."""
    parent: str
    child: str
    origin: NDArray[np.float64]
    """(4, 4): the joint's frame in the parent link's frame; at position zero it is the child link's frame."""
    axis: NDArray[np.float64]
    """(3,): unit vector in the joint's frame along or about which the child moves."""
    limits: tuple[float, float] | None
    """Lowest and highest position in radians or metres; None where the file states none."""
    max_velocity: float | None
    """In rad/s or m/s; None where the file states none above 0."""


@dataclass(frozen=True, eq=False)
class Urdf:
    """A tree of links."""

    links: tuple[str, ...]
    """The base first, then depth first in the file's order of joints, which is how PyBullet counts."""
    joints: tuple[UrdfJoint, ...]
    """The joint at position i carries the link at position i + 1."""


def read_urdf(path: Path) -> Urdf:
    """Read a URDF file.

    Raises:
        InputError: The file cannot be read, is no URDF, or its links form no tree.
    """
    root = read_xml(path)
    try:
        return _tree(
            tuple(_attribute(link, "name", "a <link>") for link in root.findall("link")),
            tuple(_joint(element) for element in root.findall("joint")),
        )
    except _FlawError as flaw:
        raise InputError(f"the robot file {path}: {flaw}") from None


def read_xml(path: Path) -> ET.Element:
    """The <robot> of a URDF file.

    Raises:
        InputError: The file cannot be read, or is no URDF.
    """
    try:
        root = ET.fromstring(path.read_bytes())  # noqa: S314  # a robot file that the user chose, not traffic
    except OSError as error:
        raise InputError(f"the robot file {path} cannot be read: {error.strerror}.") from None
    except ET.ParseError as error:
        raise InputError(f"the robot file {path} is not XML: {error}.") from None
    if root.tag != "robot":
        raise InputError(f"the robot file {path} starts with <{root.tag}>; a URDF file starts with <robot>.")
    return root


class _FlawError(Exception):
    """What is wrong inside the file; `read_urdf` adds the file's name."""


def _tree(names: tuple[str, ...], joints: tuple[UrdfJoint, ...]) -> Urdf:
    known = f"its links are {', '.join(names) or 'none'}."
    for kind, all_names in (("links", names), ("joints", tuple(joint.name for joint in joints))):
        for name in all_names:
            if all_names.count(name) > 1:
                raise _FlawError(f"two {kind} are called {name!r}.")
    children: dict[str, list[UrdfJoint]] = {name: [] for name in names}
    carrier: dict[str, str] = {}
    for joint in joints:
        for link in (joint.parent, joint.child):
            if link not in children:
                raise _FlawError(f"joint {joint.name!r} names the link {link!r}, which is not there; {known}")
        if joint.child in carrier:
            raise _FlawError(f"link {joint.child!r} hangs on two joints, {carrier[joint.child]!r} and {joint.name!r}.")
        carrier[joint.child] = joint.name
        children[joint.parent].append(joint)
    bases = [name for name in names if name not in carrier]
    if len(bases) != 1:
        raise _FlawError(
            f"exactly one link must have no parent, not {len(bases)} ({', '.join(bases) or 'none'}); {known}"
        )
    links, order, open_ = [bases[0]], [], children[bases[0]][::-1]
    while open_:
        joint = open_.pop()
        order.append(joint)
        links.append(joint.child)
        open_ += children[joint.child][::-1]
    if len(links) < len(names):
        loose = ", ".join(name for name in names if name not in links)
        raise _FlawError(f"these links hang in a loop, not on the base {bases[0]!r}: {loose}.")
    return Urdf(tuple(links), tuple(order))


def _joint(element: ET.Element) -> UrdfJoint:
    name = _attribute(element, "name", "a <joint>")
    owner = f"joint {name!r}"
    kind = _attribute(element, "type", owner)
    if kind not in JOINT_TYPES:
        raise _FlawError(f"{owner} is of type {kind!r}; known types are {', '.join(JOINT_TYPES)}.")
    origin = np.eye(4)
    origin[:3, :3] = _from_roll_pitch_yaw(*_numbers(element, "origin", "rpy", owner, (0.0, 0.0, 0.0)))
    origin[:3, 3] = _numbers(element, "origin", "xyz", owner, (0.0, 0.0, 0.0))
    axis = np.array(_numbers(element, "axis", "xyz", owner, (1.0, 0.0, 0.0)))
    length = float(np.linalg.norm(axis))
    if kind != "fixed" and length == 0.0:
        raise _FlawError(f"the <axis> of {owner} is 0 0 0; a moving joint needs a direction.")
    if kind == "prismatic" and abs(length - 1.0) > 1e-3:  # PyBullet would multiply the position by it
        raise _FlawError(f"the <axis> of {owner} has the length {length:.6g}; a prismatic joint needs length 1.")
    limits = None
    (velocity,) = _numbers(element, "limit", "velocity", owner, (0.0,))
    if kind in ("prismatic", "revolute") and element.find("limit") is not None:
        (low,) = _numbers(element, "limit", "lower", owner, (0.0,))
        (high,) = _numbers(element, "limit", "upper", owner, (0.0,))
        limits = (low, high)
    return UrdfJoint(
        name=name,
        type=kind,
        parent=_attribute(element.find("parent"), "link", f"the <parent> of {owner}"),
        child=_attribute(element.find("child"), "link", f"the <child> of {owner}"),
        origin=origin,
        axis=axis / length if length else axis,
        limits=limits,
        max_velocity=velocity if velocity > 0 else None,
    )


def _attribute(element: ET.Element | None, key: str, owner: str) -> str:
    value = None if element is None else element.get(key)
    if not value:
        raise _FlawError(f"{owner} lacks the attribute {key!r}.")
    return value


def _numbers(parent: ET.Element, tag: str, key: str, owner: str, default: tuple[float, ...]) -> tuple[float, ...]:
    element = parent.find(tag)
    text = None if element is None else element.get(key)
    if text is None:
        return default
    try:
        values = tuple(float(word) for word in text.split())
    except ValueError:
        values = ()
    if len(values) != len(default) or not all(map(math.isfinite, values)):
        count = f"{len(default)} numbers" if len(default) > 1 else "a number"
        raise _FlawError(f"{key}={text!r} in the <{tag}> of {owner} must be {count}.")
    return values


def _from_roll_pitch_yaw(roll: float, pitch: float, yaw: float) -> NDArray[np.float64]:
    """URDF's convention: rotations about the fixed x, then y, then z axis."""
    cr, sr, cp, sp, cy, sy = (f(a) for a in (roll, pitch, yaw) for f in (math.cos, math.sin))
    return np.array(
        [
            [cy * cp, cy * sp * sr - sy * cr, cy * sp * cr + sy * sr],
            [sy * cp, sy * sp * sr + cy * cr, sy * sp * cr - cy * sr],
            [-sp, cp * sr, cp * cr],
        ]
    )
