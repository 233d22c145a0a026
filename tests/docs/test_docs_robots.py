"""The page on robots says what the code does."""

from __future__ import annotations

import dataclasses
import json
import re
from itertools import pairwise

import pytest
from docs_pages import blocks, page, table

from llm3.jsonio import dumps, loads, pretty
from llm3_bullet.kinematics import Kinematics
from llm3_bullet.model import RobotModel
from llm3_bullet.robot import ParallelGripper, RobotDescription, SuctionGripper
from llm3_bullet.robot_files import locate, read_robot

PAGE = page("robots")


@pytest.mark.parametrize(
    ("heading", "structure"),
    [("The fields", RobotDescription), ("Fingers", ParallelGripper), ("A suction cup", SuctionGripper)],
)
def test_every_field_is_documented_in_order(heading, structure):
    assert table(PAGE, heading).names[: len(dataclasses.fields(structure))] == tuple(
        field.name for field in dataclasses.fields(structure)
    )


def test_the_example_is_a_description():
    robot = loads(blocks(PAGE, "json")[0].text, RobotDescription, "the example")
    assert robot.name == "my_arm"
    assert loads(pretty(robot), RobotDescription, "the example again") == robot


@pytest.mark.pybullet
def test_the_cup_of_the_page_fits_on_an_arm(tmp_path):
    """That of the example, whose URDF file ends with `tool0`."""
    joints = [f"j{i}" for i in range(6)]
    links = ["base_link", "l1", "l2", "l3", "l4", "l5", "tool0"]
    lines = [f'<link name="{link}"/>' for link in links] + [
        f'<joint name="{joint}" type="revolute"><parent link="{a}"/><child link="{b}"/><axis xyz="0 0 1"/>'
        f'<limit lower="-3" upper="3" effort="1" velocity="1"/></joint>'
        for joint, (a, b) in zip(joints, pairwise(links), strict=True)
    ]
    (tmp_path / "arm.urdf").write_text(f"<robot name='arm'>{''.join(lines)}</robot>")
    arm = {"name": "arm", "urdf": "arm.urdf", "arm_joints": joints, "home": [0.0] * 6}
    (tmp_path / "arm.json").write_text(dumps({**arm, **json.loads(blocks(PAGE, "json")[1].text)}))
    model = RobotModel(read_robot(tmp_path / "arm.json"))
    frames = Kinematics(model).link_frames(model.home[None], 0.0)[0]
    reach = frames[model.tool, 2, 3] - frames[model.link("tool0"), 2, 3]
    assert f"{reach:.2f} m long" in PAGE


def test_the_pedestal_of_the_page_is_as_large_as_it_says():
    text = locate("package://llm3_bullet/robots/pedestal.urdf").read_text()
    (size,) = set(re.findall(r'<box size="(.*?)"/>', text))
    width, _, height = size.split()
    assert f"{width} m wide and {height} m high" in PAGE


@pytest.mark.pybullet
@pytest.mark.parametrize("number", [0, 1])
def test_the_code_runs(number, tmp_path, monkeypatch, capsys):
    monkeypatch.chdir(tmp_path)
    exec(compile(blocks(PAGE, "python")[number].text, "robots.md", "exec"), {})  # the page's own code
    if number == 0:
        assert (tmp_path / "my_arm.json").is_file()
