"""Packing with a KUKA iiwa and a suction cup: another arm, another gripper, the same code."""

from __future__ import annotations

import numpy as np
import pytest
from packing_world import BAR, CUBE, after, box, carried_out, pick, place, prepared, problem

from llm3.types import EventKind, Failure, FailureKind
from llm3_boxpack.env import BoxpackEnv
from llm3_bullet.robots import iiwa
from llm3_bullet.tabletop.grasps import CUP_GAP
from llm3_bullet.workcell import Workcell

TWO = problem(box("red_box", 0.39, -0.3), box("green_box", 0.39, 0.2, BAR))


@pytest.fixture(scope="module")
def env():
    world = BoxpackEnv(TWO, Workcell(iiwa()))
    yield world
    world.close()


def test_a_box_is_taken_by_the_middle_of_its_upper_face(env):
    motion, transition = carried_out(env, env.reset(), pick("red_box"))
    grasp = transition.state.held.grasp
    assert grasp.position == pytest.approx((0.0, 0.0, CUBE[2] / 2 + CUP_GAP), abs=2e-4)
    assert [event.kind for event in motion.events] == [EventKind.ATTACH]


def test_letting_go_is_one_event(env):
    motion, transition = carried_out(env, after(env, env.reset(), pick("red_box")), place("red_box", 0.6, 0.0, 0.5))
    state = transition.state
    assert [event.kind for event in motion.events] == [EventKind.DETACH]
    assert state.held is None
    assert state.poses["red_box"].position[:2] == pytest.approx((0.6, 0.0), abs=0.002)


def test_a_cup_needs_no_room_beside_a_box(env):
    second = -0.05 + 0.035 + 0.0175 + 0.004  # 4 mm beside the first
    boxes = (("red_box", -0.05), ("green_box", second))
    actions = [action for name, y in boxes for action in (pick(name), place(name, 0.6, y))]
    assert env.goal(after(env, env.reset(), *actions)).achieved


def test_a_face_that_is_narrower_than_the_cup_is_a_precondition():
    world = BoxpackEnv(problem(box("red_box", 0.65, 0.0, (0.02, 0.05, 0.05))), Workcell(iiwa()))
    answer = world.prepare(world.reset(), pick("red_box"), np.random.default_rng(0))
    world.close()
    assert isinstance(answer, Failure)
    assert answer.kind is FailureKind.PRECONDITION
    assert answer.detail == "red_box is too narrow for the suction cup, which takes from 0.028 m."


def test_the_limits_of_the_joints_are_the_robots(env):
    assert [joint.max_acceleration for joint in env.joints] == [5.0] * 7
    assert env.joints[0].max_velocity == pytest.approx(np.radians(85))


def test_nothing_opens_on_the_way(env):
    assert prepared(env, env.reset(), pick("red_box")).before == ()
