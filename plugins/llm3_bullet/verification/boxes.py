"""Boxes in space: frames, corners, and how far a point is from one."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

from llm3_bullet.poses import Array

Frame = tuple[Sequence[float], Sequence[float]]
"""Position in metres and unit quaternion x, y, z, w, as PyBullet gives them; not a Pose, which is rounded."""
CORNERS: Array = np.array([(x, y, z) for x in (-0.5, 0.5) for y in (-0.5, 0.5) for z in (-0.5, 0.5)])
"""The corners of the unit cube about the origin, (8, 3)."""


def matrix(quaternion: Sequence[float]) -> Array:
    """The rotation of a unit quaternion x, y, z, w: (3, 3)."""
    return np.asarray(matrices(np.array([quaternion]))[0])


def matrices(quaternions: Array) -> Array:
    """The rotations of unit quaternions x, y, z, w, (N, 4): (N, 3, 3)."""
    x, y, z, w = quaternions.T
    rows = (
        (1 - 2 * (y * y + z * z), 2 * (x * y - z * w), 2 * (x * z + y * w)),
        (2 * (x * y + z * w), 1 - 2 * (x * x + z * z), 2 * (y * z - x * w)),
        (2 * (x * z - y * w), 2 * (y * z + x * w), 1 - 2 * (x * x + y * y)),
    )
    return np.moveaxis(np.array(rows), 2, 0)


def surface_distance(points: Array, frame: Frame, size: Array) -> Array:
    """How far points (N, 3) are from the surface of a box, in metres: (N,); negative inside of it."""
    local = np.abs((points - frame[0]) @ matrix(frame[1])) - size / 2
    outside = np.linalg.norm(np.maximum(local, 0.0), axis=1)
    return np.asarray(outside + np.minimum(local.max(axis=1), 0.0))
