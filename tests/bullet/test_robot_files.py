"""Robots are found by name or in files, and a description survives the way to a file and back."""

from __future__ import annotations

import sys
from dataclasses import replace

import pytest

from llm3.errors import InputError, MissingDependency, UnknownName
from llm3.jsonio import pretty
from llm3_bullet.robot import ParallelGripper, RobotDescription, SuctionGripper
from llm3_bullet.robot_files import locate, read_robot
from llm3_bullet.robots import ROBOTS, find_robot


@pytest.mark.parametrize("name", ROBOTS)
def test_a_description_survives_the_way_to_a_file_and_back(name, tmp_path):
    path = tmp_path / "robot.json"
    path.write_text(pretty(ROBOTS[name]()))
    assert find_robot(str(path)) == ROBOTS[name]()


@pytest.mark.parametrize("name", ROBOTS)
def test_a_robot_is_found_by_its_name(name):
    assert find_robot(name) == ROBOTS[name]()
    assert find_robot(name).name == name


def test_an_unknown_name_is_told_with_the_known_ones():
    with pytest.raises(UnknownName) as caught:
        find_robot("pand")
    assert str(caught.value) == (
        "unknown robot 'pand'; did you mean 'panda'? Known: iiwa, panda. A name that ends in .json is a file with a "
        "description."
    )


def test_paths_in_a_file_are_relative_to_it(tmp_path):
    robot = ROBOTS["iiwa"]()
    parts = tuple(replace(part, urdf="parts/part.urdf") for part in robot.attachments)
    (tmp_path / "robot.json").write_text(pretty(replace(robot, urdf="arm.urdf", attachments=parts)))
    read = read_robot(tmp_path / "robot.json")
    assert read.urdf == str(tmp_path / "arm.urdf")
    assert {part.urdf for part in read.attachments} == {str(tmp_path / "parts" / "part.urdf")}


def test_a_file_without_a_description_is_refused(tmp_path):
    path = tmp_path / "robot.json"
    path.write_text('{"name": "arm"}')
    with pytest.raises(InputError) as caught:
        find_robot(str(path))
    assert str(caught.value) == f"{path}: Object missing required field `urdf`"


def test_a_robot_holds_things_in_one_way(tmp_path):
    robot = ROBOTS["panda"]()
    cup = SuctionGripper(links=(), cup_radius=0.01)
    for fingers, suction in ((None, None), (robot.fingers, cup)):
        with pytest.raises(ValueError, match=r"^robot 'panda' needs fingers or suction, one of the two$"):
            replace(robot, fingers=fingers, suction=suction)


def test_the_gripper_is_the_one_that_is_there():
    assert isinstance(ROBOTS["panda"]().gripper, ParallelGripper)
    assert isinstance(ROBOTS["iiwa"]().gripper, SuctionGripper)


def test_a_package_that_is_missing_is_named(monkeypatch):
    monkeypatch.setitem(sys.modules, "robots_of_mine", None)
    with pytest.raises(MissingDependency) as caught:
        locate("package://robots_of_mine/arm.urdf")
    assert str(caught.value) == (
        "the robot file package://robots_of_mine/arm.urdf needs the Python package robots_of_mine, which is not "
        "installed."
    )


@pytest.mark.parametrize(
    "name", ["package://", "package://llm3_bullet", "package:///arm.urdf", "package://a.b/arm.urdf"]
)
def test_a_package_needs_a_path_in_it(name):
    with pytest.raises(InputError) as caught:
        locate(name)
    assert str(caught.value) == f"the robot file {name!r} must be a path, or package://NAME/PATH."


def test_every_shipped_robot_says_where_its_figures_come_from_and_has_all_limits():
    for robot in ROBOTS.values():
        description: RobotDescription = robot()
        assert description.source
        assert set(description.max_acceleration) == set(description.arm_joints)
