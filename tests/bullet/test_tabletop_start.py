"""A problem that cannot begin, or certainly not be solved, is told when the world is made: each sentence whole."""

from __future__ import annotations

from dataclasses import replace
from math import cos, pi, sin

import numpy as np
import pytest

from llm3.errors import InputError, InstanceError
from llm3.types import Pose
from llm3_bullet.robots import iiwa, panda
from llm3_bullet.scene import Box
from llm3_bullet.tabletop.box_spec import BoxSpec, check_boxes
from llm3_bullet.tabletop.rectangles import Rectangle
from llm3_bullet.tabletop.table import table
from llm3_bullet.tabletop.tabletop import Tabletop
from llm3_bullet.workcell import Workcell

PILLAR = Box("pillar", (0.06, 0.06, 0.2), Pose((0.5, 0.3, 0.1)), fixed=True)
CUBE = (0.05, 0.05, 0.05)


@pytest.fixture(scope="module")
def cells():
    made = {"panda": Workcell(panda()), "iiwa": Workcell(iiwa())}
    yield made
    for cell in made.values():
        cell.close()


def cube(name: str, x: float, y: float, height: float = 0.0, size=CUBE) -> Box:
    return BoxSpec(name, size, (x, y)).standing(height)


def refused(cell: Workcell, *boxes: Box, **asked: object) -> str:
    with pytest.raises(InstanceError) as error:
        Tabletop(cell, (table(), PILLAR), boxes, **asked)
    return str(error.value)


def test_a_box_inside_of_the_furniture_or_of_another_box(cells):
    cell = cells["panda"]
    assert refused(cell, cube("red_box", 0.5, 0.26)) == "pillar and red_box start in one another"
    assert refused(cell, cube("red_box", 0.5, 0.0, height=-0.01)) == "table and red_box start in one another"
    assert refused(cell, cube("red_box", 0.5, 0.0), cube("tan_box", 0.52, 0.0)) == (
        "red_box and tan_box start in one another"
    )
    lying = replace(PILLAR, name="tan_box", fixed=False, pose=Pose((0.5, 0.0, 0.06), (0.0, sin(0.6), 0.0, cos(0.6))))
    assert refused(cell, lying) == "table and tan_box start in one another"


def test_a_box_that_rests_on_nothing(cells):
    sentence = "red_box rests on nothing where it starts, and would fall"
    assert refused(cells["panda"], cube("red_box", 0.5, 0.0, height=0.003)) == sentence
    with pytest.raises(InstanceError) as error:  # somebody forgot the table
        Tabletop(cells["panda"], (PILLAR,), (cube("red_box", 0.5, 0.0),))
    assert str(error.value) == sentence


def test_what_touches_starts_well(cells):
    boxes = cube("red_box", 0.5, 0.0), cube("tan_box", 0.5, 0.0, height=0.05), cube("blue_box", 0.5, 0.05)
    on_top = cube("cyan_box", 0.5, 0.3, height=0.2)
    start = Tabletop(cells["panda"], (table(), PILLAR), (*boxes, on_top)).start
    assert set(start.poses) == {"red_box", "tan_box", "blue_box", "cyan_box"}


@pytest.mark.parametrize("robot", ["panda", "iiwa"])
def test_a_box_where_the_arm_stands(cells, robot):
    sentence = "the arm touches red_box where it starts: move it farther from the arm."
    assert refused(cells[robot], cube("red_box", 0.05, 0.0)) == sentence


@pytest.mark.parametrize("robot", ["panda", "iiwa"])
@pytest.mark.parametrize("angle", [0.0, 0.4, pi / 2])
def test_an_area_where_the_arm_stands(cells, robot, angle):
    direction = cos(angle), sin(angle)
    here, there = (Rectangle((x, 0.0), (0.3, 0.2), direction) for x in (0.1, 0.5))
    assert refused(cells[robot], areas={"tray": there, "mat": here}) == (
        "the arm stands on mat: move it farther from the arm."
    )
    Tabletop(cells[robot], (table(),), (), areas={"tray": there})


@pytest.mark.parametrize("robot", ["panda", "iiwa"])
@pytest.mark.parametrize("angle", [0.0, 0.4, pi / 2])
def test_an_area_of_which_no_point_is_within_reach(cells, robot, angle):
    direction = cos(angle), sin(angle)
    away, half_way = (Rectangle((x, 0.7), (0.2, 0.2), direction) for x in (1.0, 0.5))
    areas = {"tray": half_way, "mat": away}
    assert refused(cells[robot], areas=areas, to_reach=["tray", "mat"]) == (
        "mat is out of the arm's reach: move it closer to the arm."
    )
    Tabletop(cells[robot], (table(),), (), areas=areas, to_reach=["tray"])


def test_a_box_that_has_to_be_moved_and_does_not_fit_the_gripper(cells):
    wide = cube("red_box", 0.5, 0.0, size=(0.2, 0.2, 0.05))
    assert refused(cells["panda"], wide, to_move=["red_box"]) == (
        "red_box is too wide for the gripper, which takes up to 0.072 m."
    )
    Tabletop(cells["iiwa"], (table(),), (wide,), to_move=["red_box"])
    narrow = cube("red_box", 0.5, 0.0, size=(0.02, 0.05, 0.05))
    assert refused(cells["iiwa"], narrow, to_move=["red_box"]) == (
        "red_box is too narrow for the suction cup, which takes from 0.028 m."
    )
    Tabletop(cells["panda"], (table(),), (narrow,), to_move=["red_box"])


@pytest.mark.parametrize("robot", ["panda", "iiwa"])
def test_a_box_that_has_to_be_moved_and_is_farther_away_than_the_arm_is_long(cells, robot):
    near, far = cube("red_box", 0.5, 0.0), cube("tan_box", 0.9, 0.3)
    assert refused(cells[robot], near, far, to_move=["red_box", "tan_box"]) == (
        "tan_box starts out of the arm's reach: move it closer to the arm."
    )
    Tabletop(cells[robot], (table(),), (near, far), to_move=["red_box"])


@pytest.mark.parametrize("robot", ["panda", "iiwa"])
def test_what_inverse_kinematics_reaches_is_not_called_out_of_reach(cells, robot):
    cell = cells[robot]
    rng = np.random.default_rng(7)
    for x, y, yaw in rng.uniform((0.3, -0.8, -pi), (0.9, 0.8, pi), (30, 3)).round(3).tolist():
        box = BoxSpec("red_box", CUBE, (x, y), yaw).standing(0.0)
        tabletop = Tabletop(cell, (table(),), (box,))
        if not hasattr(tabletop.pick(tabletop.start, "red_box", rng), "kind"):
            Tabletop(cell, (table(),), (box,), to_move=["red_box"])


def test_what_is_wrong_with_the_robot_is_not_called_wrong_with_the_problem():
    cell = Workcell(replace(panda(), home=(0.0, -0.2, 0.3, -2.5, -0.3, 0.2, 0.1)))
    with pytest.raises(InputError) as error:
        Tabletop(cell, (table(),), ())
    assert not isinstance(error.value, InstanceError)
    cell.close()


@pytest.mark.parametrize(
    ("second", "sentence"),
    [
        (BoxSpec("red_box", CUBE, (0.7, 0.0)), "two things are called red_box"),
        (BoxSpec("tan_box", CUBE, (0.54, 0.0)), "red_box and tan_box start in one another"),
    ],
)
def test_an_instance_tells_it_by_itself(second, sentence):
    with pytest.raises(ValueError) as error:
        check_boxes((BoxSpec("red_box", CUBE, (0.5, 0.0)), second))
    assert str(error.value) == sentence
    check_boxes((BoxSpec("red_box", CUBE, (0.5, 0.0)), BoxSpec("tan_box", CUBE, (0.56, 0.0))))


def test_a_box_that_is_called_as_a_part_of_the_robot(cells):
    named = cube("panda_link7", 0.5, 0.0)
    assert refused(cells["panda"], named) == (
        "panda_link7 is what robot 'panda' calls one of its links: give the box another name"
    )
    Tabletop(cells["iiwa"], (table(), PILLAR), (named,))
