"""What a model reads of the task and the world: the words themselves, and that all it needs is in them."""

from __future__ import annotations

import re
from dataclasses import replace

import numpy as np
import pytest
from packing_world import BAR, CUBE, box, moved, problem
from scipy.spatial.transform import Rotation

from llm3.types import Entity, Held, Pose
from llm3_boxpack.actions import PICK, PLACE
from llm3_boxpack.instance import ClutterSpec
from llm3_boxpack.wording import task_text
from llm3_bullet.robots import iiwa, panda
from llm3_bullet.tabletop.grasps import OPENING_MARGIN

TWO = problem(box("red_box", 0.386, -0.4281, CUBE), box("green_box", 0.39, 0.2, BAR, 0.25))
TASK = """\
A robot arm packs boxes into a basket on a table. The arm stands at (0, 0) and faces the positive x axis; y points to \
its left and z points up. The table's surface is at z = 0. Lengths are in metres, angles in radians.
The basket is a flat tray whose sides are parallel to x and y. It has no walls.
The goal: every box lies in the basket with its whole footprint, and the gripper is empty. Boxes must not be put on \
top of one another.
The gripper takes a box from above between two fingers, on two opposite side faces no more than 0.072 m apart: the \
closer pair, or for a square box the pair along its own x direction (that of theta), and the other one only if the \
first is blocked. The fingers need about 0.030 m of free space beside these two faces, when they take a box and when \
they let go of it. Then the hand moves straight up."""


def test_the_task(make):
    assert make(TWO).task == TASK


WITH_WALLS = "It has walls 0.05 m high: basket_wall_front, basket_wall_back, basket_wall_right, basket_wall_left."
HEIGHTS = """
The hand passes over what is lower than it. Of each box is told how high the fingertips and the palm are above what \
it stands on when the gripper takes it or lets go of it. What is higher than the fingertips must not be where a \
finger is: beside the middle of each of the two faces. What is higher than the palm must not be below it: its middle \
is above that of the box, and it is longest from finger to finger. Of the arm is told how far from (0, 0) the middle \
of a box can be, at least and at most, so that the arm surely reaches it, however it is turned."""


def with_fingers(**changes):
    """The Panda with another hand."""
    return replace(panda(), fingers=replace(panda().fingers, **changes))


def test_an_arm_of_unknown_reach_is_not_told_of(make):
    known = task_text(TWO.with_walls(0.05), panda())
    unknown = task_text(TWO.with_walls(0.05), replace(panda(), reach_from_above=None))
    assert known.startswith(unknown)
    assert known.removeprefix(unknown) == (
        " Of the arm is told how far from (0, 0) the middle of a box can be, at least and at most, so that the arm "
        "surely reaches it, however it is turned."
    )


def test_the_task_with_walls_tells_of_the_height_of_the_hand(make):
    walled = TASK.replace("It has no walls.", WITH_WALLS)
    assert make(TWO, 0.05).task == walled + HEIGHTS


def test_the_task_with_walls_for_a_hand_of_unknown_size():
    walled = TASK.replace("It has no walls.", WITH_WALLS)
    assert task_text(TWO.with_walls(0.05), with_fingers(finger_width=None)) == walled


CLUTTERED = replace(TWO, clutter=(ClutterSpec("glue_can", (0.04, 0.06, 0.026), (0.65, 0.0)),))


def test_the_task_with_things_in_the_way(make):
    sentence = "Boxes must not be put on top of one another."
    assert (
        make(CLUTTERED).task
        == TASK.replace(sentence, f"{sentence} What is not to be packed may end anywhere.") + HEIGHTS
    )


def test_the_state_with_walls_and_things_in_the_way_tells_all_of_the_hand(make):
    env = make(CLUTTERED, 0.05)
    tray, red, _, can, hand, arm = env.describe(env.reset())
    assert tray.properties["wall height"] == 0.05
    assert red == Entity(
        "red_box",
        {
            "position": (0.386, -0.428, 0.035),
            "size": CUBE,
            "theta": 0.0,
            "to be packed": "yes",
            "fingertips": 0.04,
            "palm": 0.086,
        },
    )
    assert can.properties["to be packed"] == "no"
    assert (can.properties["fingertips"], can.properties["palm"]) == (0.012, 0.058)
    assert hand == Entity(
        "hand",
        {"fingers reach beyond a face": 0.03, "finger width": 0.021, "palm length": 0.208, "palm width": 0.063},
    )
    assert arm == Entity("arm", {"surely reaches": (0.43, 0.77)})


def test_the_figures_are_those_of_the_robot_in_use():
    text = task_text(TWO, with_fingers(max_opening=0.1, finger_reach=0.05))
    assert "no more than 0.092 m apart" in text
    assert "about 0.054 m of free space" in text


def test_with_a_suction_cup_the_task_says_how_that_takes_a_box():
    common = TASK[: TASK.index("The gripper takes")]
    assert task_text(TWO, iiwa()) == (
        f"{common}The gripper is a suction cup, which takes a box from above by the middle of its upper face; the face "
        "must be at least 0.028 m wide. It needs no free space beside the box. When it has taken a box, or let go of "
        "it, it moves straight up."
    )


def test_the_initial_state(make):
    env = make(TWO)
    assert env.describe(env.reset()) == (
        Entity(
            "basket",
            {"center": (0.65, 0.0), "x range": (0.54, 0.76), "y range": (-0.105, 0.105), "floor height": 0.01},
        ),
        Entity("red_box", {"position": (0.386, -0.428, 0.035), "size": CUBE, "theta": 0.0}),
        Entity("green_box", {"position": (0.39, 0.2, 0.035), "size": BAR, "theta": 0.25}),
    )


def test_a_held_box(make):
    env = make(TWO)
    state = env.reset()
    poses = {"red_box": state.poses["red_box"]}
    held = replace(state, poses=poses, held=Held("green_box", Pose((0.0, 0.0, 0.0))))
    assert env.describe(held)[2] == Entity("green_box", {"size": BAR, "position": "in the gripper"})


def test_a_toppled_box_is_described_as_it_lies(make):
    env = make(TWO)
    lying = Rotation.from_euler("xz", [np.pi / 2, 0.5]).as_matrix()
    state = moved(env.reset(), "green_box", 0.5, 0.1, 0.0175, lying)
    assert env.describe(state)[2] == Entity(
        "green_box", {"position": (0.5, 0.1, 0.018), "size": (0.105, 0.07, 0.035), "theta": 0.5}
    )


def test_a_leaning_box_has_a_posture_and_no_theta(make):
    env = make(TWO)
    leaning = Rotation.from_euler("x", np.radians(20)).as_matrix()
    state = moved(env.reset(), "green_box", 0.5, 0.1, 0.04, leaning)
    assert env.describe(state)[2] == Entity(
        "green_box", {"position": (0.5, 0.1, 0.04), "size": BAR, "posture": "leaning"}
    )


def test_no_number_has_more_digits_than_a_millimetre_and_none_is_minus_zero(domain, make):
    for seed in range(5):
        env = make(domain.instance("hard-large", seed))
        for entity in env.describe(env.reset()):
            for value in entity.properties.values():
                for number in value if isinstance(value, tuple) else (value,):
                    assert number == round(number, 3)
                    assert not repr(number).startswith("-0.0,")
                    assert repr(number) != "-0.0"


def test_all_that_a_solution_needs_can_be_read(domain, make):
    """Where the boxes and the basket are, how large they are, and how much room the hand takes."""
    instance = domain.instance("hard-small", 0)
    env = make(instance)
    entities = {entity.name: entity.properties for entity in env.describe(env.reset())}
    assert set(entities) == {"basket", *env.objects}
    x, y = entities["basket"]["x range"], entities["basket"]["y range"]
    assert (x[1] - x[0], y[1] - y[0]) == pytest.approx(instance.basket.size)
    for spec in instance.boxes:
        assert entities[spec.name]["position"][:2] == spec.position
        assert entities[spec.name]["size"] == spec.size
        assert entities[spec.name]["theta"] == spec.yaw
    room = float(re.search(r"about ([\d.]+) m of free space", env.task).group(1))
    assert room == pytest.approx(panda().gripper.finger_reach + OPENING_MARGIN / 2, abs=0.0005)


def test_the_actions_have_the_ranges_of_the_paper():
    assert (PICK.objects, PICK.parameters) == (("box",), ())
    assert PLACE.objects == ("box",)
    assert [(p.name, p.low, p.high, p.unit) for p in PLACE.parameters] == [
        ("x", 0.0, 1.0, "m"),
        ("y", -1.0, 1.0, "m"),
        ("theta", -3.14, 3.14, "rad"),
    ]
