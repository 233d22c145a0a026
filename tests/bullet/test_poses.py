"""Poses and matrices say the same."""

from __future__ import annotations

import numpy as np
from hypothesis import given
from hypothesis import strategies as st
from scipy.spatial.transform import Rotation

from llm3.types import Pose
from llm3_bullet.poses import as_matrix, as_pose, quaternions, turned

lengths = st.floats(-2.0, 2.0)
unit_quaternions = (
    st.tuples(*[st.floats(-1.0, 1.0)] * 4)
    .filter(lambda q: np.linalg.norm(q) > 0.1)
    .map(lambda q: tuple(np.array(q) / np.linalg.norm(q)))
)
poses = st.builds(Pose, st.tuples(lengths, lengths, lengths), unit_quaternions)


@given(pose=poses)
def test_a_matrix_is_the_rotation_of_the_quaternion_and_exactly_orthogonal(pose):
    matrix = as_matrix(pose)
    np.testing.assert_allclose(matrix[:3, :3], Rotation.from_quat(pose.orientation).as_matrix(), atol=1e-14)
    np.testing.assert_allclose(matrix[:3, :3] @ matrix[:3, :3].T, np.eye(3), atol=1e-14)
    np.testing.assert_array_equal(matrix[:3, 3], pose.position)
    np.testing.assert_array_equal(matrix[3], (0, 0, 0, 1))


@given(pose=poses)
def test_a_pose_survives_the_way_through_a_matrix(pose):
    there = as_pose(as_matrix(pose))
    assert there.position == pose.position
    same = np.abs(np.dot(there.orientation, pose.orientation))  # a half turn has two quaternions
    assert abs(same - 1) < 1e-4


@given(angle=st.floats(-10.0, 10.0))
def test_turning_is_about_the_vertical(angle):
    np.testing.assert_allclose(turned(angle), Rotation.from_euler("z", angle).as_matrix(), atol=1e-14)


@given(pose=poses)
def test_one_rotation_and_many_give_the_same_quaternion(pose):
    matrix = as_matrix(pose)
    one, many = as_pose(matrix).orientation, quaternions(matrix[None])[0]
    assert min(np.abs(one - many).max(), np.abs(one + many).max()) < 2e-5
