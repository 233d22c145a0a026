"""What stands on what, as geometry has it."""

from __future__ import annotations

import numpy as np
from hypothesis import given
from hypothesis import strategies as st
from scipy.spatial.transform import Rotation

from llm3.types import Pose
from llm3_bullet.tabletop.resting import TOUCH, boxes_on, is_over, rests_on, rests_on_table, support_of
from llm3_bullet.tabletop.surprises import STILL, is_still

SIZE = (0.05, 0.06, 0.04)
SIZES = dict.fromkeys("abc", SIZE)
angles = st.floats(-3.14, 3.14)


def pose(x: float, y: float, z: float, yaw: float = 0.0, tilt: float = 0.0) -> Pose:
    return Pose((x, y, z), tuple((Rotation.from_euler("x", tilt) * Rotation.from_euler("z", yaw)).as_quat()))


@given(angles)
def test_a_box_stands_on_the_table_however_it_is_turned(yaw):
    assert rests_on_table(pose(0.4, 0.1, 0.02, yaw), SIZE)
    assert not rests_on_table(pose(0.4, 0.1, 0.02 + 2 * TOUCH, yaw), SIZE)


def test_it_stands_on_whatever_face():
    assert rests_on_table(pose(0.4, 0.1, 0.03, tilt=np.pi / 2), SIZE)
    assert not rests_on_table(pose(0.4, 0.1, 0.02, tilt=np.pi / 2), SIZE)


@given(angles, angles, st.floats(-0.02, 0.02), st.floats(-0.02, 0.02))
def test_a_box_rests_on_another_one_that_it_overlaps_and_touches(yaw, other_yaw, dx, dy):
    below = pose(0.4, 0.1, 0.02, yaw)
    assert rests_on(pose(0.4 + dx, 0.1 + dy, 0.06, other_yaw), SIZE, below, SIZE)
    assert not rests_on(pose(0.4 + dx, 0.1 + dy, 0.06 + 2 * TOUCH, other_yaw), SIZE, below, SIZE)
    assert not rests_on(pose(0.4 + dx, 0.2 + dy, 0.06, other_yaw), SIZE, below, SIZE)
    assert not rests_on(below, SIZE, pose(0.4 + dx, 0.1 + dy, 0.06, other_yaw), SIZE)


def test_resting_is_more_than_half_a_step_from_being_over():
    below, over, beside = pose(0.4, 0.1, 0.02), pose(0.424, 0.1, 0.06), pose(0.44, 0.1, 0.06)
    assert rests_on(beside, SIZE, below, SIZE)
    assert is_over(over, below, SIZE)
    assert not is_over(beside, below, SIZE)


def test_who_stands_on_whom():
    poses = {"a": pose(0.4, 0.0, 0.02), "b": pose(0.41, 0.02, 0.06), "c": pose(0.4, -0.035, 0.06)}
    assert boxes_on("a", poses, SIZES) == ("b", "c")
    assert boxes_on("b", poses, SIZES) == ()
    assert support_of("b", poses, SIZES) == "a"
    assert support_of("c", poses, SIZES) is None  # its centre is beside a
    assert support_of("a", poses, SIZES) is None


@given(st.floats(0.0, 1.0), angles, st.floats(0.0, 0.02))
def test_a_box_has_not_moved_if_no_corner_has(along, direction, turn):
    before = pose(0.4, 0.1, 0.02)
    shift = along * 2 * STILL
    after = pose(0.4 + shift * np.cos(direction), 0.1 + shift * np.sin(direction), 0.02, turn)
    corners = np.array(np.meshgrid(*[[-0.5, 0.5]] * 3)).reshape(3, -1).T * SIZE

    def placed(where: Pose) -> np.ndarray:
        return Rotation.from_quat(where.orientation).apply(corners) + where.position

    farthest = np.linalg.norm(placed(after) - placed(before), axis=1).max()
    if is_still(before, after, SIZE):
        assert farthest <= STILL + 1e-6
    elif shift < 1e-9 and turn < 1e-4:
        raise AssertionError("a box that did not move at all has not moved")
