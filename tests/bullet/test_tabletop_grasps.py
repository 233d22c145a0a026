from __future__ import annotations

from dataclasses import replace
from math import pi

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from scipy.spatial.transform import Rotation

from llm3_bullet.robots.panda import panda
from llm3_bullet.tabletop.grasps import OPENING_MARGIN, PALM_GAP, held_width, top_grasps
from llm3_bullet.tabletop.stance import stance

GRIPPER = panda().gripper
CENTER = np.array([0.4, -0.1, 0.035])
angles = st.floats(-pi, pi)
narrow = st.floats(0.01, 0.07)
axes = st.sampled_from([(1.0, 0.0, 0.0), (0.0, 1.0, 0.0), (0.0, -1.0, 0.0)])


def grasps(size, yaw=0.0, gripper=GRIPPER):
    standing = stance(Rotation.from_euler("z", yaw).as_matrix(), size)
    assert standing is not None
    return top_grasps(CENTER, standing, gripper)


def closing(grasp, gripper=GRIPPER):
    return grasp.tool[:3, :3] @ gripper.closing_axis


@given(st.tuples(narrow, narrow, narrow), angles, axes)
def test_every_grasp_points_down_over_the_centre_and_closes_level(size, yaw, axis):
    gripper = replace(GRIPPER, closing_axis=axis)
    found = grasps(size, yaw, gripper)
    assert found
    for grasp in found:
        rotation = grasp.tool[:3, :3]
        assert rotation @ rotation.T == pytest.approx(np.eye(3), abs=1e-9)
        assert np.linalg.det(rotation) == pytest.approx(1.0)
        assert rotation[:, 2] == pytest.approx((0.0, 0.0, -1.0))
        assert closing(grasp, gripper)[2] == pytest.approx(0.0, abs=1e-9)
        assert grasp.tool[:2, 3] == pytest.approx(CENTER[:2])


@given(st.tuples(narrow, narrow, narrow), angles)
def test_the_fingers_close_across_the_closer_pair_of_faces_with_the_hand_either_way_round(size, yaw):
    found = grasps(size, yaw)
    assert {grasp.width for grasp in found} == {min(size[:2])}
    side = 0 if size[0] <= size[1] else 1
    across = np.array([np.cos(yaw + side * pi / 2), np.sin(yaw + side * pi / 2), 0.0])
    first, second = (closing(grasp) for grasp in found[:2])
    assert first == pytest.approx(-second, abs=1e-9)
    assert abs(first @ across) == pytest.approx(1.0)
    assert len(found) == (4 if size[0] == size[1] else 2)


@given(narrow, narrow, angles)
def test_a_square_box_is_taken_both_ways(side, height, yaw):
    directions = [closing(grasp) for grasp in grasps((side, side, height), yaw)]
    assert len(directions) == 4
    for wanted in np.arange(4) * pi / 2 + yaw:
        assert any(d @ (np.cos(wanted), np.sin(wanted), 0.0) > 0.999999 for d in directions)


@pytest.mark.parametrize(
    ("size", "widths"),
    [
        ((0.105, 0.035, 0.07), {0.035}),
        ((0.072, 0.105, 0.07), {0.072}),
        ((0.0721, 0.105, 0.07), set()),
        ((0.0721, 0.0721, 0.07), set()),
    ],
)
def test_a_box_that_is_too_wide_both_ways_has_no_grasp(size, widths):
    assert GRIPPER.max_opening - OPENING_MARGIN == pytest.approx(0.072)
    assert {grasp.width for grasp in grasps(size)} == widths


@given(st.floats(0.005, 0.5))
def test_the_tool_is_above_the_centre_inside_the_box_and_the_palm_above_its_top(height):
    (grasp, _) = grasps((0.03, 0.04, height))
    above = grasp.tool[2, 3] - CENTER[2]
    assert 0 < above <= height / 2
    assert above + GRIPPER.palm_height >= height / 2 + PALM_GAP - 1e-12


def test_a_box_of_the_settings_is_taken_12_mm_above_its_centre_and_a_flat_one_lower():
    assert grasps((0.035, 0.035, 0.07))[0].tool[2, 3] == pytest.approx(0.035 + 0.012)
    assert grasps((0.035, 0.035, 0.04))[0].tool[2, 3] == pytest.approx(0.035 + 0.010)


@given(st.tuples(narrow, narrow, narrow), angles, axes)
def test_a_held_box_is_as_wide_as_the_grasp_said(size, yaw, axis):
    gripper = replace(GRIPPER, closing_axis=axis)
    box = np.eye(4)
    box[:3, :3] = Rotation.from_euler("z", yaw).as_matrix()
    box[:3, 3] = CENTER
    for grasp in grasps(size, yaw, gripper):
        assert held_width(size, np.linalg.inv(grasp.tool) @ box, gripper) == grasp.width
