"""Robots are found by name or in files, and a description survives the way to a file and back."""

from __future__ import annotations

import sys
from dataclasses import replace

import pytest

from llm3.errors import InputError, MissingDependency, UnknownName
from llm3.jsonio import dumps, pretty, to_builtins
from llm3_bullet.robot import ParallelGripper, RobotDescription, SuctionGripper
from llm3_bullet.robot_files import locate, read_robot
from llm3_bullet.robots import ROBOTS, find_robot, in_place

ACROSS = "closing_axis must be a unit vector across the tool's z axis, such as [0.0, 1.0, 0.0]"


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
    cup = SuctionGripper(links=("cup",), cup_radius=0.01)
    for fingers, suction in ((None, None), (robot.fingers, cup)):
        with pytest.raises(ValueError, match=r"^robot 'panda' needs fingers or suction, one of the two$"):
            replace(robot, fingers=fingers, suction=suction)


@pytest.mark.parametrize(
    ("fields", "sentence"),
    [
        ({"max_velocity": {"a": 0.0}}, "max_velocity of 'a' must be more than 0 and at most 1000, not 0"),
        ({"max_acceleration": {"a": -1}}, "max_acceleration of 'a' must be more than 0 and at most 1000, not -1"),
        (
            {"joint_limits": {"a": [1.0, 1.0]}},
            "joint_limits of 'a' must be a lower and a higher number, not [1.0, 1.0]",
        ),
        (
            {"joint_limits": {"a": [-1e300, 1e300]}},
            "joint_limits of 'a' must be a lower and a higher number, not [-1e+300, 1e+300]",
        ),
        ({"urdf": ""}, "urdf must name a file"),
        ({"base": {"position": [0, 0, 1e308]}}, "the base must be within 1000 m, not at [0.0, 0.0, 1e+308]"),
        (
            {"attachments": [{"urdf": "a.urdf", "link": "panda_link8", "pose": {"position": [0, -2000, 0]}}]},
            "the pose of an attachment must be within 1000 m, not at [0.0, -2000.0, 0.0] - at `$.attachments[0]`",
        ),
    ],
)
def test_a_value_that_makes_no_sense_is_refused(tmp_path, fields, sentence):
    assert refusal(tmp_path, fields) == sentence


@pytest.mark.parametrize(
    ("fields", "sentence"),
    [
        ({"joints": ["panda_finger_joint1"]}, "fingers need two joints, not 1"),
        ({"links": []}, "the links of the fingers must name the hand and the fingers"),
        ({"max_opening": -1}, "max_opening must be more than 0 and at most 1000, not -1"),
        ({"finger_reach": -0.01}, "finger_reach must be a length of 0 or more, in metres, not -0.01"),
        ({"palm_height": 1e9}, "palm_height must be a length of 0 or more, in metres, not 1e+09"),
        ({"tip_depth": -0.1}, "tip_depth must be a length of 0 or more, in metres, not -0.1"),
        ({"finger_width": -1}, "finger_width must be more than 0 and at most 1000, not -1"),
        ({"palm_size": [0.2, -0.1]}, "palm_size must be more than 0 and at most 1000, not -0.1"),
        *(({"closing_axis": axis}, f"{ACROSS}, not {axis}") for axis in ([0.0] * 3, [0.0, 0.0, 1.0], [0.0, 2.0, 0.0])),
    ],
)
def test_a_gripper_that_makes_no_sense_is_refused(tmp_path, fields, sentence):
    fingers = to_builtins(ROBOTS["panda"]().fingers)
    assert refusal(tmp_path, {"fingers": {**fingers, **fields}}) == f"{sentence} - at `$.fingers`"


@pytest.mark.parametrize(
    ("fields", "sentence"),
    [
        ({"links": []}, "the links of the suction must name the cup"),
        ({"cup_radius": -1}, "cup_radius must be more than 0 and at most 1000, not -1"),
    ],
)
def test_a_cup_that_makes_no_sense_is_refused(tmp_path, fields, sentence):
    suction = {"links": ["cup"], "cup_radius": 0.01, **fields}
    assert refusal(tmp_path, {"fingers": None, "suction": suction}) == f"{sentence} - at `$.suction`"


def refusal(tmp_path, fields):
    """What is said of a file with the Panda's description and these fields, after the file's name."""
    path = tmp_path / "robot.json"
    path.write_text(dumps({**to_builtins(ROBOTS["panda"]()), **fields}))
    with pytest.raises(InputError) as caught:
        find_robot(str(path))
    assert str(caught.value).startswith(f"{path}: ")
    return str(caught.value).removeprefix(f"{path}: ")


@pytest.mark.parametrize("name", ROBOTS)
def test_the_text_of_a_description_stands_for_its_file(name, tmp_path):
    path = tmp_path / "robot.json"
    path.write_text(pretty(ROBOTS[name]()))
    assert in_place(name) == name
    assert find_robot(in_place(str(path))) == find_robot(str(path))
    assert in_place(in_place(str(path))) == in_place(str(path))


def test_a_text_that_is_no_description_is_refused():
    with pytest.raises(InputError, match=r"^the robot: Object missing required field `name`$"):
        find_robot("{}")


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
