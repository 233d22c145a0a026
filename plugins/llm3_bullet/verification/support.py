"""Whether a box can stay where it is: its centre has to be over what it touches."""

from __future__ import annotations

from collections.abc import Iterable

import numpy as np

from llm3_bullet.poses import Array
from llm3_bullet.verification.boxes import Frame, matrix, surface_distance

SPACING = 0.004
"""Metres between the points of a box's surface that are looked at, at most."""
TOUCH = 0.0015
"""How far a point may be from what it rests on, in metres: PyBullet's margin, and the rounding of poses."""
DIRECTIONS = np.linspace(0.0, 2 * np.pi, 72, endpoint=False)


def overhang(frame: Frame, size: Array, others: Iterable[tuple[Frame, Array]]) -> float:
    """How far a box's centre is from being over what touches it, seen from above, in metres; infinite if nothing does.

    What touches it no lower than its centre, such as a ceiling, holds nothing.

    Args:
        frame: Where the box is.
        size: Its sides.
        others: Frames and sizes of what may touch it.
    """
    points = _surface(size) @ matrix(frame[1]).T + frame[0]
    touching = np.zeros(len(points), dtype=bool)
    for other_frame, other_size in others:
        touching |= surface_distance(points, other_frame, other_size) <= TOUCH
    touched = points[touching]
    if not len(touched) or touched[:, 2].min() >= frame[0][2]:
        return float("inf")
    ways = np.column_stack([np.cos(DIRECTIONS), np.sin(DIRECTIONS)])
    beyond = np.array(frame[0][:2]) @ ways.T - (touched[:, :2] @ ways.T).max(axis=0)
    return float(max(0.0, beyond.max()))


def _surface(size: Array) -> Array:
    """Points on the surface of a box about the origin, the corners among them, (N, 3)."""
    sides = [np.linspace(-side / 2, side / 2, max(2, int(np.ceil(side / SPACING)) + 1)) for side in size]
    faces = []
    for axis in range(3):
        for end in (0, -1):
            grid = [side[[end]] if i == axis else side for i, side in enumerate(sides)]
            faces.append(np.stack(np.meshgrid(*grid, indexing="ij"), axis=-1).reshape(-1, 3))
    return np.concatenate(faces)
