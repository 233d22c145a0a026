"""The stage shows what it is told, and leaves planning alone."""

from __future__ import annotations

import numpy as np
import pytest

from llm3.types import Event, EventKind, Held, Motion, Pose, Segment
from llm3_bullet.clients import connect
from llm3_bullet.kinematics import Kinematics
from llm3_bullet.model import RobotModel
from llm3_bullet.poses import as_matrix
from llm3_bullet.robots import panda
from llm3_bullet.scene import Box
from llm3_bullet.stage import Camera, Stage

RED, CUBE = (0.9, 0.0, 0.0), Box("cube", (0.2, 0.2, 0.2), Pose((0.6, 0.0, 0.1)))


@pytest.fixture(scope="module")
def model():
    return RobotModel(panda())


@pytest.fixture
def waits():
    return []


@pytest.fixture
def stage(model, waits):
    made = Stage(connect(), model, {"cube": RED}, Camera(target=(0.6, 0.0, 0.1), distance=1.0), waits.append)
    yield made
    made.close()


def redness(picture):
    red, green, blue = picture.reshape(-1, 3).astype(int).T
    return int(((red > 100) & (green < 60) & (blue < 60)).sum())


def test_a_picture_has_the_size_asked_for_and_shows_the_box_in_its_colour(stage, model):
    stage.show([CUBE], model.home, None, 0.08)
    picture = stage.picture(160, 120)
    assert picture.shape == (120, 160, 3)
    assert redness(picture) > 300


def test_the_same_state_gives_the_same_picture(stage, model):
    stage.show([CUBE], model.home, None, 0.08)
    first = stage.picture(80, 60)
    stage.show([Box("cube", CUBE.size, Pose((0.3, 0.5, 0.1)))], model.home + 0.1, None, 0.0)
    assert not np.array_equal(stage.picture(80, 60), first)
    stage.show([CUBE], model.home, None, 0.08)
    assert np.array_equal(stage.picture(80, 60), first)


def test_a_held_box_moves_with_the_tool_until_it_is_let_go(stage, model):
    tool = Kinematics(model).tool
    there, away = model.home, model.home + np.array([0.6, 0, 0, 0, 0, 0, 0])
    grasp = Pose((0.0, 0.0, 0.05))
    attach = (Event(EventKind.GRIPPER, opening=0.07), Event(EventKind.ATTACH, object="cube", grasp=grasp))
    stage.show([CUBE], there, None, 0.08)
    carry = Segment("transit", (tuple(there), tuple(away)), attach)
    leave = Segment("retreat", (tuple(away), tuple(there)), (Event(EventKind.DETACH, object="cube"),))
    stage.play(Motion((carry, leave)))
    picture = stage.picture(160, 120)

    where = tool(away[None])[0] @ as_matrix(grasp)
    stage.show([Box("cube", CUBE.size, Pose(tuple(where[:3, 3])))], there, None, 0.07)
    assert abs(redness(picture) - redness(stage.picture(160, 120))) < 0.1 * redness(picture) + 50


def test_a_state_with_a_held_box_shows_it_in_the_gripper(stage, model):
    stage.show([CUBE], model.home, None, 0.08)
    on_the_ground = stage.picture(160, 120)
    stage.show([], model.home, Held("cube", Pose((0.0, 0.0, 0.1))), 0.07)
    assert not np.array_equal(stage.picture(160, 120), on_the_ground)


def test_a_motion_is_played_frame_by_frame(stage, model, waits):
    stage.show([CUBE], model.home, None, 0.08)
    end = tuple(model.home + np.array([0.3, 0, 0, 0, 0, 0, 0]))
    stage.play(Motion((Segment("transit", (tuple(model.home), end)),)), step=0.03, frame=0.01)
    assert waits == [0.01] * 10


def test_closing_waits_once(stage, waits):
    stage.close(last_look=2.0)
    stage.close(last_look=2.0)
    assert waits == [2.0]
