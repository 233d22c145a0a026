"""Constructed cases whose answer is known."""

from __future__ import annotations

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from llm3.types import Pose
from llm3_bullet.clients import connect
from llm3_bullet.collision import CollisionChecker
from llm3_bullet.scene import Box, HeldBox, Scene

CUBE = (0.04, 0.04, 0.04)


@pytest.fixture
def home(checker):
    return checker.kinematics.model.home


@pytest.fixture
def tool(checker, home):
    """Where the tool is at home, (3,)."""
    return checker.kinematics.tool(home[None])[0, :3, 3]


def link_place(checker, name: str) -> np.ndarray:
    model = checker.kinematics.model
    return checker.kinematics.link_frames(model.home[None], 0.08)[0, model.link(name), :3, 3]


def cube(name: str, place, **options) -> Box:
    return Box(name, CUBE, Pose(tuple(place)), **options)


def test_nothing_around_means_no_contacts(checker, home):
    assert checker.view(Scene(opening=0.08)).contacts(home) == ()


@pytest.mark.parametrize(
    ("link", "part"),
    [("panda_link1", "arm"), ("panda_link5", "arm"), ("panda_link7", "arm"), ("panda_hand", "gripper")],
)
def test_a_contact_names_the_part_of_the_robot_and_the_box(checker, home, link, part):
    scene = Scene((cube("far", (2.0, 0.0, 0.0)), cube("red", link_place(checker, link))), opening=0.08)
    contacts = checker.view(scene).contacts(home)
    assert (contacts[0].part, contacts[0].object) == (part, "red")
    assert {contact.object for contact in contacts} == {"red"}
    assert contacts[0].depth > 0
    assert not checker.view(scene).valid(home[None])[0]


def test_a_finger_is_part_of_the_gripper(checker, home, tool):
    scene = Scene((Box("red", (0.01, 0.3, 0.01), Pose(tuple(tool))),), opening=0.08)
    (contact,) = checker.view(scene).contacts(home)
    assert (contact.part, contact.object) == ("gripper", "red")


def test_the_opening_of_the_gripper_counts(checker, home, tool):
    """Between open fingers there is room for a box; closed ones run into it."""
    scene = [Scene((cube("red", tool),), opening=opening) for opening in (0.08, 0.02)]
    assert checker.view(scene[0]).contacts(home) == ()
    assert checker.view(scene[1]).contacts(home)[0].part == "gripper"


@settings(max_examples=20, deadline=None)
@given(depth=st.floats(-0.004, 0.01), yaw=st.floats(-3.0, 3.0))
def test_a_held_box_reports_its_depth_and_the_way_out(checkers, depth, yaw):
    checker = checkers["panda"]
    home = checker.kinematics.model.home
    tool = checker.kinematics.tool(home[None])[0, :3, 3]
    held = HeldBox("red", (0.07, 0.07, 0.07), Pose((0.0, 0.0, 0.0), (0.0, 0.0, np.sin(yaw / 2), np.cos(yaw / 2))))
    top = tool[2] - 0.035 + depth
    shelf = Box("shelf", (0.5, 0.5, 0.1), Pose((tool[0], tool[1], top - 0.05)), fixed=True)
    contacts = checker.view(Scene((shelf,), held, 0.07)).contacts(home, clearance=0.005)
    contact = next(contact for contact in contacts if contact.part == "held red")
    assert contact.object == "shelf"
    assert contact.depth == pytest.approx(depth, abs=0.0015)
    np.testing.assert_allclose(contact.normal, (0, 0, 1), atol=0.02)


@pytest.mark.parametrize("direction", [(1, 0, 0), (-1, 0, 0), (0, 1, 0), (0, -1, 0), (0, 0, -1)])
def test_the_normal_points_from_the_object_to_the_part(checker, home, tool, direction):
    held = HeldBox("red", (0.07, 0.07, 0.07), Pose((0.0, 0.0, 0.0)))
    wall = Box("wall", CUBE, Pose(tuple(tool + np.array(direction) * (0.035 + 0.02 - 0.002))))
    contacts = checker.view(Scene((wall,), held, 0.07)).contacts(home)
    contact = next(contact for contact in contacts if contact.part == "held red")
    assert contact.depth == pytest.approx(0.002, abs=0.0015)
    np.testing.assert_allclose(contact.normal, -np.array(direction), atol=0.02)


@settings(max_examples=10, deadline=None)
@given(lift=st.floats(0.001, 0.005))
def test_a_link_s_depth_grows_as_the_box_comes_up(checkers, lift):
    checker = checkers["panda"]
    home = checker.kinematics.model.home
    tool = checker.kinematics.tool(home[None])[0, :3, 3]
    fingertips = tool[2] - 0.0075

    def depth(top: float) -> float:
        plate = Box("plate", (0.3, 0.3, 0.02), Pose((tool[0], tool[1], top - 0.01)))
        (contact,) = checker.view(Scene((plate,), None, 0.08)).contacts(home, clearance=0.01)
        np.testing.assert_allclose(contact.normal, (0, 0, 1), atol=0.02)
        return contact.depth

    assert depth(fingertips) == pytest.approx(0.0, abs=0.0015)
    assert depth(fingertips + lift) == pytest.approx(lift, abs=0.0015)


def test_the_deepest_contact_comes_first(checker, home, tool):
    held = HeldBox("red", (0.07, 0.07, 0.07), Pose((0.0, 0.0, 0.0)))
    walls = [
        Box(f"wall{depth}", CUBE, Pose(tuple(tool + np.array(way) * (0.055 - depth / 1000))))
        for depth, way in ((1, (1, 0, 0)), (8, (-1, 0, 0)), (4, (0, 0, -1)))
    ]
    contacts = checker.view(Scene(tuple(walls), held, 0.07)).contacts(home)
    assert [c.object for c in contacts if c.part == "held red"] == ["wall8", "wall4", "wall1"]


def test_a_robot_can_touch_itself(checker, home):
    folded = home.copy()
    folded[5] = 0.0  # the hand turned back along the forearm
    folded[6] = 0.0
    contacts = checker.view(Scene(opening=0.08)).contacts(folded)
    assert ("gripper", "itself") in {(contact.part, contact.object) for contact in contacts}


def test_a_held_box_can_touch_the_arm(checker, home):
    pole = HeldBox("pole", (0.02, 0.02, 1.5), Pose((0.0, 0.0, 0.0), (0.0, np.sin(-0.6), 0.0, np.cos(-0.6))))
    assert ("held pole", "itself") in {
        (contact.part, contact.object) for contact in checker.view(Scene((), pole, 0.02)).contacts(home)
    }


def test_a_held_box_may_touch_the_gripper(checker, home):
    held = HeldBox("red", (0.07, 0.07, 0.07), Pose((0.0, 0.0, -0.02)))
    assert checker.view(Scene((), held, 0.07)).contacts(home) == ()


def test_the_base_may_stand_on_what_is_fixed_and_on_nothing_else(checker, home):
    def touched(fixed: bool) -> list[str]:
        ground = Box("ground", (1.0, 1.0, 0.1), Pose((0.0, 0.0, -0.05)), fixed)
        return [contact.object for contact in checker.view(Scene((ground,), None, 0.08)).contacts(home)]

    assert touched(fixed=True) == []
    assert touched(fixed=False) == ["ground"]


def test_boxes_are_loaded_once_however_many_scenes_are_looked_at(checkers, home):
    kinematics = checkers["panda"].kinematics
    with connect() as client:
        checker = CollisionChecker(client, kinematics.model, kinematics)
        held = HeldBox("c", CUBE, Pose((0.0, 0.0, 0.0)))
        scenes = [
            Scene((cube("a", (0.5, 0.1 * i, 0.1)), cube("b", (0.7, 0.0, 0.1))), held if i % 2 else None)
            for i in range(6)
        ]
        for scene in scenes * 3:
            checker.view(scene).contacts(home)
        assert client.getNumBodies() == 1 + 3  # the robot and, at most, three cubes at a time
