"""Poses as matrices and back."""

from __future__ import annotations

import math

import numpy as np
from numpy.typing import NDArray
from scipy.spatial.transform import Rotation

from llm3.types import Pose

Array = NDArray[np.float64]


def as_matrix(pose: Pose) -> Array:
    """The pose as a homogeneous transform, (4, 4); its rotation is exactly orthogonal, the rounding aside."""
    a, b, c, d = pose.orientation  # written out, because a general rotation object takes ten times as long to make
    scale = math.sqrt(2 / (a * a + b * b + c * c + d * d))
    a, b, c, d = a * scale, b * scale, c * scale, d * scale
    x, y, z = pose.position
    return np.array(
        (
            (1 - b * b - c * c, a * b - c * d, a * c + b * d, x),
            (a * b + c * d, 1 - a * a - c * c, b * c - a * d, y),
            (a * c - b * d, b * c + a * d, 1 - a * a - b * b, z),
            (0.0, 0.0, 0.0, 1.0),
        )
    )


def turned(angle: float) -> Array:
    """A rotation about the vertical by an angle in radians, (3, 3)."""
    cosine, sine = math.cos(angle), math.sin(angle)
    return np.array(((cosine, -sine, 0.0), (sine, cosine, 0.0), (0.0, 0.0, 1.0)))


def as_pose(matrix: Array) -> Pose:
    """The homogeneous transform (4, 4) as a pose, rounded to the grid of states."""
    return Pose(tuple(matrix[:3, 3].tolist()), _quaternion(matrix[:3, :3].tolist()))


def _quaternion(rotation: list[list[float]]) -> tuple[float, float, float, float]:
    """The unit quaternion x, y, z, w of a rotation; `quaternions` of a single one takes ten times as long.

    Each candidate is the quaternion times four times one of its components; the longest one has lost the least to
    cancellation: S. W. Shepperd, "Quaternion from rotation matrix", Journal of Guidance and Control 1(3), 1978.
    """
    (xx, xy, xz), (yx, yy, yz), (zx, zy, zz) = rotation
    candidates = (
        (1 + xx - yy - zz, xy + yx, xz + zx, zy - yz),
        (xy + yx, 1 - xx + yy - zz, yz + zy, xz - zx),
        (xz + zx, yz + zy, 1 - xx - yy + zz, yx - xy),
        (zy - yz, xz - zx, yx - xy, 1 + xx + yy + zz),
    )
    x, y, z, w = max(candidates, key=lambda q: sum(c * c for c in q))
    length = math.sqrt(x * x + y * y + z * z + w * w)
    return x / length, y / length, z / length, w / length


def quaternions(matrices: Array) -> Array:
    """The rotations of homogeneous transforms (N, 4, 4) as unit quaternions x, y, z, w: (N, 4)."""
    return np.asarray(Rotation.from_matrix(matrices[:, :3, :3]).as_quat())
