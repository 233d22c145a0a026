from __future__ import annotations

from itertools import permutations, product
from math import pi

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from scipy.spatial.transform import Rotation

from llm3_bullet.tabletop.stance import stance

SIZE = (0.105, 0.035, 0.07)
SIGNED = [np.eye(3)[:, list(order)] * signs for order in permutations(range(3)) for signs in product((1, -1), repeat=3)]
FACES = [matrix for matrix in SIGNED if np.linalg.det(matrix) > 0]
"""The 24 ways in which a box can stand with its sides along the world's axes."""
angles = st.floats(-pi, pi)


def about_z(angle: float) -> np.ndarray:
    return Rotation.from_euler("z", angle).as_matrix()


def tilted(angle: float, direction: float) -> np.ndarray:
    """A turn by `angle` about a horizontal axis."""
    return Rotation.from_rotvec(angle * np.array([np.cos(direction), np.sin(direction), 0.0])).as_matrix()


def test_there_are_24():
    assert len(FACES) == 24


@given(st.sampled_from(FACES), angles)
def test_a_stance_and_its_yaw_give_the_orientation_back(face, yaw):
    orientation = about_z(yaw) @ face
    standing = stance(orientation, SIZE)
    assert standing is not None
    assert standing.orientation(standing.yaw) == pytest.approx(orientation, abs=1e-9)


@given(st.sampled_from(FACES), angles)
def test_the_extents_are_the_sides_along_the_horizontal_axes_and_the_vertical_one(face, yaw):
    standing = stance(about_z(yaw) @ face, SIZE)
    assert standing is not None
    assert sorted(standing.axes) == [0, 1, 2]
    assert standing.extent == tuple(SIZE[axis] for axis in standing.axes)
    assert abs(face[2, standing.axes[2]]) == 1.0
    first = (about_z(yaw) @ face)[:, standing.axes[0]]
    assert (np.cos(standing.yaw), np.sin(standing.yaw)) == pytest.approx((first[0], first[1]), abs=1e-9)


@given(st.sampled_from(FACES), angles, angles)
def test_another_yaw_turns_the_box_and_leaves_it_on_its_face(face, yaw, other):
    standing = stance(about_z(yaw) @ face, SIZE)
    assert standing is not None
    again = stance(standing.orientation(other), SIZE)
    assert again is not None
    assert (again.axes, again.extent) == (standing.axes, standing.extent)
    assert np.exp(1j * again.yaw) == pytest.approx(np.exp(1j * other), abs=1e-9)


@given(st.sampled_from(FACES), angles, angles)
def test_the_footprint_is_what_the_corners_cover(face, yaw, other):
    standing = stance(about_z(yaw) @ face, SIZE)
    assert standing is not None
    corners = np.array(np.meshgrid(*[[-0.5, 0.5]] * 3)).reshape(3, -1).T * SIZE
    for angle in (None, other):
        orientation = about_z(yaw) @ face if angle is None else standing.orientation(angle)
        covered = {tuple(np.round(c, 9) + 0.0) for c in (corners @ orientation.T)[:, :2] + (0.4, 0.1)}
        footprint = standing.footprint((0.4, 0.1), angle)
        assert {tuple(np.round(c, 9) + 0.0) for c in footprint.corners} == covered


@given(st.sampled_from(FACES), angles, st.floats(0.0, np.radians(4.9)), angles)
def test_a_box_that_tilts_a_little_stands_on_the_same_face(face, yaw, tilt, direction):
    upright, almost = (stance(o @ about_z(yaw) @ face, SIZE) for o in (np.eye(3), tilted(tilt, direction)))
    assert upright is not None
    assert almost is not None
    assert almost.extent == upright.extent
    assert almost.base == pytest.approx(upright.base)
    assert np.linalg.det(almost.base) == pytest.approx(1.0)


@given(st.sampled_from(FACES), angles, st.floats(np.radians(5.1), np.radians(40.0)), angles)
def test_a_box_that_tilts_more_stands_on_none(face, yaw, tilt, direction):
    assert stance(tilted(tilt, direction) @ about_z(yaw) @ face, SIZE) is None
