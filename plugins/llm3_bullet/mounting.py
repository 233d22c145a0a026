"""A robot's URDF file as a simulator loads it: its own or, on a base or with attachments, one made of several."""

from __future__ import annotations

from collections.abc import Iterable, Iterator
from contextlib import contextmanager
from pathlib import Path
from tempfile import TemporaryDirectory
from xml.etree import ElementTree as ET

import numpy as np
from numpy.typing import NDArray

from llm3.errors import InputError
from llm3.types import Pose
from llm3_bullet.poses import as_matrix
from llm3_bullet.robot import Attachment, RobotDescription
from llm3_bullet.robot_files import locate
from llm3_bullet.urdf import read_xml

WORLD = "world"
"""The name of the link that carries a robot which does not stand at the world's origin."""
_ORIGIN = Pose((0.0, 0.0, 0.0))
_PACKAGE = "package://"


@contextmanager
def urdf_file(description: RobotDescription) -> Iterator[Path]:
    """The file to load; if it is made of several, it is a temporary one, which is gone after the block.

    Raises:
        MissingDependency: A file lies in a Python package that is not installed.
        InputError: A file cannot be read, or the files do not fit each other.
    """
    own = locate(description.urdf)
    if not description.attachments and description.base == _ORIGIN:
        yield own
        return
    robot = _read(own)
    if description.base != _ORIGIN:
        _set_on_base(robot, description.base, own)
    for part in description.attachments:
        _attach(robot, part, own)
    with TemporaryDirectory(prefix="llm3-") as folder:
        file = Path(folder) / own.name
        ET.ElementTree(robot).write(file)
        yield file


def _read(file: Path) -> ET.Element:
    """A URDF whose mesh files are found wherever it is written to."""
    robot = read_xml(file)
    for mesh in robot.iter("mesh"):
        name = mesh.get("filename", "")
        if name.startswith(_PACKAGE):
            mesh.set("filename", _in_package(name, file))
        elif name and "://" not in name:
            mesh.set("filename", str((file.parent / name).resolve()))
    return robot


def _in_package(name: str, file: Path) -> str:
    """Where a ROS package's mesh is: its path begins in a folder above the URDF file, as PyBullet looks for it too."""
    path = name.removeprefix(_PACKAGE)
    folders = file.resolve().parents
    return next((str(folder / path) for folder in folders if (folder / path).is_file()), name)


def _set_on_base(robot: ET.Element, base: Pose, file: Path) -> None:
    if WORLD in _names(robot, "link"):
        raise InputError(
            f"the robot file {file} has a link {WORLD!r} already, so its base cannot be moved: change the joint in it."
        )
    joint = _fixed_joint(WORLD, _base_link(robot, file), base)
    robot.insert(0, ET.Element("link", name=WORLD))
    robot.append(joint)


def _attach(robot: ET.Element, part: Attachment, file: Path) -> None:
    """Add the part's links and joints, and a fixed joint to them."""
    part_file = locate(part.urdf)
    added, links = _read(part_file), _names(robot, "link")
    if part.link not in links:
        raise InputError(
            f"{part_file} is to be attached to {part.link!r}, but the links of {file} are {', '.join(links)}."
        )
    for kind in ("link", "joint"):
        for name in sorted(set(_names(robot, kind)) & set(_names(added, kind))):
            raise InputError(f"{part_file} has a {kind} {name!r}, and the robot has one already: rename one of them.")
    joint = _fixed_joint(part.link, _base_link(added, part_file), part.pose)
    robot.extend((*added.findall("link"), *added.findall("joint"), joint))


def _base_link(robot: ET.Element, file: Path) -> str:
    children = {child.get("link") for child in robot.findall("joint/child")}
    bases = [name for name in _names(robot, "link") if name not in children]
    if len(bases) != 1:
        raise InputError(
            f"the robot file {file}: exactly one link must have no parent, not {len(bases)} "
            f"({', '.join(bases) or 'none'})."
        )
    return bases[0]


def _fixed_joint(parent: str, child: str, pose: Pose) -> ET.Element:
    joint = ET.Element("joint", name=f"{parent}_to_{child}", type="fixed")
    ET.SubElement(joint, "origin", xyz=_numbers(pose.position), rpy=_numbers(_roll_pitch_yaw(as_matrix(pose))))
    ET.SubElement(joint, "parent", link=parent)
    ET.SubElement(joint, "child", link=child)
    return joint


def _roll_pitch_yaw(turn: NDArray[np.float64]) -> tuple[float, float, float]:
    """The rotation of a transform (4, 4) as URDF writes it; where only roll plus or minus yaw is fixed, roll is 0."""
    cosine = float(np.hypot(turn[2, 1], turn[2, 2]))
    pitch = float(np.arctan2(-turn[2, 0], cosine))
    if cosine < 1e-9:
        return 0.0, pitch, float(np.arctan2(-turn[0, 1], turn[1, 1]))
    return float(np.arctan2(turn[2, 1], turn[2, 2])), pitch, float(np.arctan2(turn[1, 0], turn[0, 0]))


def _names(robot: ET.Element, tag: str) -> list[str]:
    return [element.get("name", "") for element in robot.findall(tag)]


def _numbers(values: Iterable[float]) -> str:
    return " ".join(repr(float(value)) for value in values)
