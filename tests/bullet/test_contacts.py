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
    assert all(contact.link.startswith("panda_") for contact in contacts)
    assert not checker.view(scene).valid(home[None])[0]


def test_a_finger_is_part_of_the_gripper(checker, home, tool):
    scene = Scene((Box("red", (0.01, 0.3, 0.01), Pose(tuple(tool))),), opening=0.08)
    contacts = checker.view(scene).contacts(home)
    assert {(contact.part, contact.object) for contact in contacts} == {("gripper", "red")}
    assert {contact.link for contact in contacts} == {"panda_leftfinger", "panda_rightfinger"}


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
        contact = checker.view(Scene((plate,), None, 0.08)).contacts(home, clearance=0.01)[0]
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
    assert ("gripper", "panda_hand", "itself", "panda_link5") in {
        (c.part, c.link, c.object, c.other_link) for c in contacts
    }


def test_a_held_box_can_touch_the_arm(checker, home):
    pole = HeldBox("pole", (0.02, 0.02, 1.5), Pose((0.0, 0.0, 0.0), (0.0, np.sin(-0.6), 0.0, np.cos(-0.6))))
    contacts = checker.view(Scene((), pole, 0.02)).contacts(home)
    assert {(c.part, c.link, c.object) for c in contacts} == {("held pole", "", "itself")}
    assert "panda_link1" in {c.other_link for c in contacts}


def test_every_box_that_a_link_touches_is_named_with_the_link(checker, home, tool):
    """Two boxes in the hand's way and one beside the elbow: a contact for each link and box that touch."""
    elbow = link_place(checker, "panda_link4")
    aside = np.array([0.0, 0.04, 0.0])
    boxes = (cube("one", tool + aside), cube("another", tool - aside), cube("far", elbow))
    contacts = checker.view(Scene(boxes, None, 0.08)).contacts(home)
    touched = {(contact.link, contact.object) for contact in contacts}
    assert len(touched) == len(contacts)
    fingers = {contact.object: contact.link for contact in contacts if "finger" in contact.link}
    assert sorted(fingers) == ["another", "one"]
    assert sorted(fingers.values()) == ["panda_leftfinger", "panda_rightfinger"]
    assert "far" in {name for _, name in touched}
    assert {contact.part for contact in contacts if contact.object == "far"} == {"arm"}


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
    with connect() as client, connect() as step_client:
        checker = CollisionChecker(client, kinematics.model, kinematics, step_client)
        held = HeldBox("c", CUBE, Pose((0.0, 0.0, 0.0)))
        scenes = [
            Scene((cube("a", (0.5, 0.1 * i, 0.1)), cube("b", (0.7, 0.0, 0.1))), held if i % 2 else None)
            for i in range(6)
        ]
        for scene in scenes * 3:
            checker.view(scene).valid(home[None], coarse=False)
            checker.view(scene).valid(home[None])
        for world in (client, step_client):
            assert world.getNumBodies() == 1 + 3  # the robot and, at most, three cubes at a time


@pytest.mark.parametrize("clearance", [-0.0005, 0.0, 0.005])
def test_every_contact_is_told_also_where_coarse_tests_go_first(checkers, clearance):
    """Against PyBullet alone: the same questions, all of them asked."""
    checker, rng = checkers["panda"], np.random.default_rng(3)
    model = checker.kinematics.model
    boxes = tuple(cube(f"box{i}", tuple(rng.uniform((-0.5, -0.5, 0.0), (0.5, 0.5, 0.6)))) for i in range(6))
    view = checker.view(Scene(boxes, None, 0.04))
    told = 0
    for q in rng.uniform(model.low, model.high, (150, model.dof)):
        contacts = view.contacts(q, clearance)
        assert bool(contacts) == (not view.valid(q[None], clearance, coarse=False)[0])
        assert [c.depth for c in contacts] == sorted((c.depth for c in contacts), reverse=True)
        told += len(contacts)
    assert told > 50
