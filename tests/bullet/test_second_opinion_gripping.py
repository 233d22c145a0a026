"""The second opinion on what the gripper does: each thing that makes no sense has its sentence."""

from __future__ import annotations

import re
from dataclasses import replace

import pytest
from shelf_world import (
    ATTACH,
    CARRY,
    CARRYING,
    DETACH,
    DROP,
    DROPPED,
    LEAVE,
    SHELF,
    START,
    TAKE,
    WIDE,
    WIDTH,
    box_at,
    found,
    gripper,
    lines,
    moved_by,
)

from llm3.types import Event, EventKind, Held, Pose, Segment, State
from llm3_bullet.clients import connect
from llm3_bullet.robot import RobotDescription, SuctionGripper
from llm3_bullet.scene import Box
from llm3_bullet.verification import PlainWorld, Playback


@pytest.fixture(scope="module")
def robot(descriptions):
    return descriptions["toy"]


def test_a_box_that_is_not_where_the_gripper_takes_it(robot):
    start = replace(START, poses={"box": box_at(0.01)})
    assert lines(robot, start=start)[0] == f"{CARRYING}: box jumps by 10.00 mm into the gripper"


def test_fingers_that_do_not_touch_what_they_take(robot):
    loose = replace(CARRY, events=(gripper(0.04), ATTACH))
    assert found(robot, moved_by(TAKE, loose))[0] == f"{CARRYING}: left is 5.00 mm from box, which it takes"


@pytest.mark.parametrize(("extra", "sound"), [(0.0, True), (0.0009, True), (0.0011, False), (0.0039, False)])
def test_fingers_that_close_less_than_the_box_is_wide(robot, extra, sound):
    """The rounding of states and waypoints is forgiven, and no more: a box that is not held tight falls."""
    told = found(robot, moved_by(TAKE, replace(CARRY, events=(gripper(WIDTH + extra), ATTACH))))
    assert (told == []) is sound
    assert all(line.endswith(" from box, which it takes") for line in told)


@pytest.mark.parametrize("away", [(0.0, 0.0, 0.03), (0.0305, 0.0, 0.0)], ids=["above", "in front"])
def test_fingers_beside_a_box_do_not_close_on_it(robot, away):
    """They nearly touch it, but from where they cannot hold it."""
    place = box_at(0.0)
    moved = replace(place, position=tuple(a + b for a, b in zip(place.position, away, strict=True)))
    grasp = Pose(away)
    step = moved_by(TAKE, replace(CARRY, events=(gripper(0.012), replace(ATTACH, grasp=grasp))))
    told = lines(robot, (step,), replace(START, poses={"box": moved}), fixed=())
    assert any(line == f"{CARRYING}: left touches box, which it takes, but does not close on it" for line in told)


def test_a_gripper_that_closes_on_nothing_is_sound(robot):
    """The fingers meet, as they do."""
    start = replace(START, poses={})
    step = replace(moved_by(TAKE, replace(CARRY, events=(gripper(0.0),))), state=State({}, CARRY.waypoints[-1]))
    assert lines(robot, (step,), start, fixed=()) == []


def test_fingers_inside_of_what_they_take(robot):
    tight = replace(CARRY, events=(gripper(0.02), ATTACH))
    told = found(robot, moved_by(TAKE, tight))
    assert f"{CARRYING}: left is 5.00 mm deep in box, which it takes" in told
    assert f"{CARRYING}: right is 6.92 mm deep in box, which it takes" in told  # 7 mm; it is a sphere


def test_fingers_that_close_through_a_plate(robot):
    """It is clear of them before and after: the left finger is 20 mm thick and moves by 25 mm."""
    fixed = (SHELF, Box("plate", (0.02, 0.001, 0.02), Pose((0.0, 0.1375, 1.09)), fixed=True))
    (told,) = lines(robot, fixed=fixed)
    assert re.sub(r"\d+\.\d\d mm", "# mm", told) == f"{CARRYING}, waypoint 0.00: left touches plate, # mm deep"


@pytest.mark.parametrize(
    ("events", "sentence"),
    [
        ((gripper(WIDTH),), "the gripper holds nothing, and the state after it says box"),
        (
            (gripper(WIDTH), replace(ATTACH, object="bax")),
            "the gripper takes 'bax', and there is no such thing; there are box",
        ),
        ((gripper(WIDTH), ATTACH, ATTACH), "the gripper takes box while it holds box"),
        ((gripper(0.1), gripper(WIDTH), ATTACH), "the gripper is to open to 0.1 m, and its range is 0 to 0.08 m"),
        ((gripper(-0.01), gripper(WIDTH), ATTACH), "the gripper is to open to -0.01 m, and its range is 0 to 0.08 m"),
        ((gripper(WIDTH), ATTACH, gripper(WIDE)), "the gripper moves from 0.03 to 0.08 m while it holds box"),
        ((Event(EventKind.GRIPPER), gripper(WIDTH), ATTACH), "an event of the kind 'gripper' lacks its opening"),
        (
            (gripper(WIDTH), replace(ATTACH, grasp=None), ATTACH),
            "an event of the kind 'attach' lacks its object or grasp",
        ),
        ((gripper(WIDTH), ATTACH, Event(EventKind.DETACH)), "an event of the kind 'detach' lacks its object or grasp"),
        ((replace(DETACH, object="bax"), gripper(WIDTH), ATTACH), "the gripper lets go of 'bax', and holds nothing"),
        (
            (gripper(WIDTH), replace(ATTACH, grasp=Pose((0.0, 0.0, 0.003)))),
            "box jumps by 3.00 mm into the gripper",
        ),
    ],
)
def test_events_that_make_no_sense(robot, events, sentence):
    told = found(robot, moved_by(TAKE, replace(CARRY, events=events)))
    assert sentence in {line.partition(": ")[2] for line in told}


def test_a_box_that_is_not_let_go(robot):
    told = found(robot, moved_by(DROP, replace(LEAVE, events=())))
    assert f"{DROPPED}: the gripper holds box, and the state after it says nothing" in told
    assert f"{DROPPED}: the state after it says where box is, which the gripper holds" in told


# ---- suction ---------------------------------------------------------------------------------------------------------


CUP_URDF = """
<robot name="cup">
  <link name="rail"/>
  <link name="tube"><inertial><mass value="1"/><inertia ixx="1" iyy="1" izz="1" ixy="0" ixz="0" iyz="0"/></inertial>
    <collision><origin xyz="0 0 0.045"/><geometry><cylinder radius="0.01" length="0.09"/></geometry></collision></link>
  <link name="tip"/>
  <joint name="slide" type="prismatic"><parent link="rail"/><child link="tube"/><origin xyz="0 0.1 1"/>
    <axis xyz="1 0 0"/><limit lower="-0.3" upper="0.5" effort="1" velocity="1"/></joint>
  <joint name="tip_joint" type="fixed"><parent link="tube"/><child link="tip"/><origin xyz="0 0 0.09"/></joint>
</robot>
"""
RACK = Box("rack", (0.5, 0.09, 0.02), Pose((0.0, 0.18, 1.08)), fixed=True)
"""On it lies a long box, whose front end the cup takes from below."""
LONG = (0.04, 0.14, 0.04)


@pytest.fixture(scope="module")
def cup(tmp_path_factory):
    """A cup on a tube on a slide; the middle of its rim is where the other arm has its tool."""
    file = tmp_path_factory.mktemp("cup") / "cup.urdf"
    file.write_text(CUP_URDF)
    suction = SuctionGripper(links=("tube",), cup_radius=0.01)
    return RobotDescription(
        name="cup", urdf=str(file), arm_joints=("slide",), tool_link="tip", home=(0.0,), suction=suction
    )


def sucked(robot, x, *before):
    """What is told if the cup, at x = 0, takes a box that lies at this x."""
    grasp = Pose((x, 0.04, 0.02))
    segment = Segment("carry", ((0.0,), (0.1,)), (*before, replace(ATTACH, grasp=grasp)))
    step = replace(moved_by(TAKE, segment), state=State({}, (0.1,), Held("box", grasp)))
    pose = Pose((x, 0.14, 1.11))
    with connect() as client:
        playback = Playback(PlainWorld(client, robot, (RACK,), (Box("box", LONG, pose),)), State({"box": pose}, (0.0,)))
        playback.play(step)
        return [str(defect) for defect in playback.findings.report().defects]


def test_a_cup_that_touches_what_it_takes_is_sound(cup):
    assert sucked(cup, 0.0) == []
    assert sucked(cup, 0.009) == []


def test_a_cup_whose_rim_reaches_beyond_the_face(cup):
    assert sucked(cup, 0.017) == [f"{CARRYING}: the cup's rim is 7.00 mm from the surface of box, which it takes"]


def test_a_cup_cannot_open(cup):
    assert sucked(cup, 0.0, gripper(0.0)) == []
    assert sucked(cup, 0.0, gripper(0.01)) == [
        f"{CARRYING}: the gripper is to open to 0.01 m, and its range is 0 to 0 m"
    ]
