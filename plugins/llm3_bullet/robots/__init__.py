"""Robots that are described already."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from pathlib import Path
from types import MappingProxyType

from llm3.errors import UnknownName
from llm3.jsonio import dumps, loads
from llm3_bullet.robot import RobotDescription
from llm3_bullet.robot_files import read_robot
from llm3_bullet.robots.iiwa import iiwa
from llm3_bullet.robots.panda import panda

__all__ = ["ROBOTS", "find_robot", "iiwa", "in_place", "panda"]

ROBOTS: Mapping[str, Callable[[], RobotDescription]] = MappingProxyType({"iiwa": iiwa, "panda": panda})
"""By name."""


def in_place(name: str) -> str:
    """The JSON text of the description in place of a file's name; any other name as it is.

    Raises:
        InputError: The file cannot be read, or does not hold a description.
    """
    return dumps(read_robot(Path(name))) if name.endswith(".json") else name


def find_robot(name: str) -> RobotDescription:
    """A robot by its name here, from the JSON file of this name, such as ``"my_arm.json"``, or from JSON text.

    Raises:
        UnknownName: There is no such robot.
        InputError: The file cannot be read, or does not hold a description.
    """
    if name.endswith(".json"):
        return read_robot(Path(name))
    if name.startswith("{"):
        return loads(name, RobotDescription, "the robot")
    if name not in ROBOTS:
        raise UnknownName("robot", name, ROBOTS, remark="A name that ends in .json is a file with a description.")
    return ROBOTS[name]()
