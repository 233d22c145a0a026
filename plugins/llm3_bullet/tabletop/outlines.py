"""What stands on the table, seen from above, for figures."""

from __future__ import annotations

import itertools

import numpy as np
from numpy.typing import NDArray

from llm3.types import Pose, Shape
from llm3_bullet.poses import as_matrix
from llm3_bullet.scene import Size
from llm3_bullet.tabletop.rectangles import Rectangle


def outline_of_area(name: str, area: Rectangle) -> Shape:
    """The outline of something that stands where it is in every state."""
    return Shape(name, _points(area.corners), fixed=True)


def outline_of_box(name: str, size: Size, pose: Pose) -> Shape:
    """The convex hull of a box's corners, as the box may lean."""
    from scipy.spatial import ConvexHull

    matrix = as_matrix(pose)
    corners = np.array(list(itertools.product((-0.5, 0.5), repeat=3))) * size
    seen = (corners @ matrix[:3, :3].T + matrix[:3, 3])[:, :2]
    return Shape(name, _points(seen[ConvexHull(seen).vertices]))


def _points(corners: NDArray[np.float64]) -> tuple[tuple[float, float], ...]:
    return tuple((float(x), float(y)) for x, y in corners)
