"""The page on robots says what the code does."""

from __future__ import annotations

import dataclasses

import pytest
from docs_pages import blocks, page, table

from llm3.jsonio import loads, pretty
from llm3_bullet.robot import ParallelGripper, RobotDescription, SuctionGripper

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
    (example,) = blocks(PAGE, "json")
    robot = loads(example.text, RobotDescription, "the example")
    assert robot.name == "my_arm"
    assert loads(pretty(robot), RobotDescription, "the example again") == robot


@pytest.mark.pybullet
@pytest.mark.parametrize("number", [0, 1])
def test_the_code_runs(number, tmp_path, monkeypatch, capsys):
    monkeypatch.chdir(tmp_path)
    exec(compile(blocks(PAGE, "python")[number].text, "robots.md", "exec"), {})  # the page's own code
    if number == 0:
        assert (tmp_path / "my_arm.json").is_file()
