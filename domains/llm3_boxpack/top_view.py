"""The basket and the boxes, seen from above."""

from __future__ import annotations

import itertools

import numpy as np
from numpy.typing import NDArray

from llm3.types import Pose, Shape, State
from llm3_boxpack.instance import BoxpackInstance
from llm3_bullet.poses import as_matrix


def top_view(instance: BoxpackInstance, state: State) -> tuple[Shape, ...]:
    """The basket's inside, and the outline of each box that is not held."""
    basket = Shape("basket", _points(instance.basket.area.corners), fixed=True)
    poses = ((box, state.poses.get(box.name)) for box in instance.boxes)
    return (basket, *(Shape(box.name, _outline(box.size, pose)) for box, pose in poses if pose))


def _outline(size: tuple[float, float, float], pose: Pose) -> tuple[tuple[float, float], ...]:
    """The convex hull of the box's corners, as the box may lean."""
    from scipy.spatial import ConvexHull

    matrix = as_matrix(pose)
    corners = np.array(list(itertools.product((-0.5, 0.5), repeat=3))) * size
    seen = (corners @ matrix[:3, :3].T + matrix[:3, 3])[:, :2]
    return _points(seen[ConvexHull(seen).vertices])


def _points(corners: NDArray[np.float64]) -> tuple[tuple[float, float], ...]:
    return tuple((float(x), float(y)) for x, y in corners)
