"""Poses as matrices and back."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray
from scipy.spatial.transform import Rotation

from llm3.types import Pose

Array = NDArray[np.float64]


def as_matrix(pose: Pose) -> Array:
    """The pose as a homogeneous transform, (4, 4); its rotation is exactly orthogonal, the rounding aside."""
    matrix = np.eye(4)
    matrix[:3, :3] = Rotation.from_quat(pose.orientation).as_matrix()
    matrix[:3, 3] = pose.position
    return matrix


def as_pose(matrix: Array) -> Pose:
    """The homogeneous transform (4, 4) as a pose, rounded to the grid of states."""
    return Pose(tuple(matrix[:3, 3]), tuple(quaternions(matrix[None])[0]))


def quaternions(matrices: Array) -> Array:
    """The rotations of homogeneous transforms (N, 4, 4) as unit quaternions x, y, z, w: (N, 4)."""
    return np.asarray(Rotation.from_matrix(matrices[:, :3, :3]).as_quat())
