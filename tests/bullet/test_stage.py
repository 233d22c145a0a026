"""The stage shows what it is told, and leaves planning alone."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest

from llm3.types import Camera, Held, Moment, Pose
from llm3_bullet.clients import connect
from llm3_bullet.kinematics import Kinematics
from llm3_bullet.model import RobotModel
from llm3_bullet.poses import as_matrix
from llm3_bullet.robots import panda
from llm3_bullet.scene import Box
from llm3_bullet.stage import BulletStage

RED, CUBE = (0.9, 0.0, 0.0), Box("cube", (0.2, 0.2, 0.2), Pose((0.6, 0.0, 0.1)))


@pytest.fixture(scope="module")
def model():
    return RobotModel(panda())


@pytest.fixture
def stage(model):
    made = BulletStage(connect(), model, [CUBE], {"cube": RED}, Camera(target=(0.5, 0.0, 0.3), distance=1.2))
    yield made
    made.close()


@pytest.fixture
def standing(model):
    """The cube on the ground, the arm at home."""
    return Moment(tuple(model.home), {"cube": CUBE.pose}, opening=0.08)


def redness(picture):
    red, green, blue = picture.reshape(-1, 3).astype(int).T
    return int(((red > 100) & (green < 60) & (blue < 60)).sum())


def shown(stage, moment):
    stage.show(moment)
    return stage.picture(160, 120)


def test_a_picture_has_the_size_asked_for_and_shows_the_box_in_its_colour(stage, standing):
    picture = shown(stage, standing)
    assert (picture.shape, picture.dtype) == ((120, 160, 3), np.uint8)
    assert redness(picture) > 300


def test_the_same_moment_gives_the_same_picture_whatever_was_shown_before(stage, standing, model):
    first = shown(stage, standing)
    elsewhere = Moment(tuple(model.home + 0.1), {"cube": Pose((0.3, 0.5, 0.1))}, opening=0.0)
    assert not np.array_equal(shown(stage, elsewhere), first)
    assert np.array_equal(shown(stage, standing), first)


def test_what_is_held_is_where_the_hand_is(stage, standing, model):
    grasp = Pose((0.0, 0.0, 0.05))
    away = model.home + np.array([0.6, 0, 0, 0, 0, 0, 0])
    held = Moment(tuple(away), {}, Held("cube", grasp), opening=0.07)
    where = Kinematics(model).tool(away[None])[0] @ as_matrix(grasp)
    put = replace(held, held=None, poses={"cube": Pose(tuple(where[:3, 3]))})
    difference = redness(shown(stage, held)) - redness(shown(stage, put))
    assert abs(difference) < 0.1 * redness(shown(stage, put)) + 50


def test_fingers_are_open_until_their_opening_is_known(stage, standing):
    closed, wide = (shown(stage, replace(standing, opening=opening)) for opening in (0.0, 0.08))
    assert not np.array_equal(closed, wide)
    assert np.array_equal(shown(stage, replace(standing, opening=None)), wide)


def test_a_closed_stage_can_be_closed_again(stage):
    stage.close()
    stage.close()
