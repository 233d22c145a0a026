"""Where robots come from: their URDF files, and descriptions in JSON files."""

from __future__ import annotations

from dataclasses import replace
from importlib.util import find_spec
from pathlib import Path

from llm3.errors import InputError, MissingDependency
from llm3.jsonio import read_file
from llm3_bullet.robot import RobotDescription

_PACKAGE = "package://"


def locate(file: str) -> Path:
    """The file that is meant by a path, or by ``package://NAME/PATH``: a path inside an installed Python package.

    Raises:
        MissingDependency: The package is not installed.
        InputError: Only the package is named, and no file in it.
    """
    if not file.startswith(_PACKAGE):
        return Path(file)
    package, _, path = file.removeprefix(_PACKAGE).partition("/")
    if not package.isidentifier() or not path:
        raise InputError(f"the robot file {file!r} must be a path, or package://NAME/PATH.")
    found = find_spec(package)  # its folder is all that is needed, so it is not imported
    if found is None or not found.submodule_search_locations:
        raise MissingDependency(f"the robot file {file} needs the Python package {package}, which is not installed.")
    return Path(found.submodule_search_locations[0]) / path


def read_robot(path: Path) -> RobotDescription:
    """Read a description from a JSON file; paths in it are relative to the file's folder, and absolute in the answer.

    Raises:
        InputError: The file cannot be read, or does not hold a description.
    """
    robot = read_file(path, RobotDescription)
    attachments = tuple(replace(part, urdf=_beside(path, part.urdf)) for part in robot.attachments)
    return replace(robot, urdf=_beside(path, robot.urdf), attachments=attachments)


def _beside(path: Path, file: str) -> str:
    return file if file.startswith(_PACKAGE) else str((path.parent / file).resolve())
