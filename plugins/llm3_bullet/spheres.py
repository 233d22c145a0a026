"""Spheres that cover a convex hull: coarse, but a hundred of them are tested in one line of numpy."""

from __future__ import annotations

import math
from itertools import pairwise

import numpy as np
from numpy.typing import NDArray
from scipy.spatial import ConvexHull

Array = NDArray[np.float64]


def cover(points: Array, slab: float) -> tuple[Array, Array]:
    """Cover the convex hull of points with spheres.

    The hull is cut across its longest axis into slabs of equal thickness, and each slab gets a sphere. Of the
    coordinate axes and the principal axes the one that leads to the smallest spheres counts as the longest.

    Args:
        points: (V, 3), not all in one plane, in metres.
        slab: Greatest thickness of a slab in metres.

    Returns:
        Centres (K, 3) and radii (K,).
    """
    hull = ConvexHull(points)
    edges = np.unique(np.sort(hull.simplices[:, [0, 1, 1, 2, 2, 0]].reshape(-1, 2)), axis=0)
    principal = np.linalg.svd(points - points.mean(axis=0), full_matrices=False)[2]
    covers = [_cover_along(axis, points, edges, slab) for axis in (*np.eye(3), *principal)]
    return min(covers, key=lambda spheres: float(np.sum(spheres[1] ** 3)))


def cover_box(size: tuple[float, float, float]) -> tuple[Array, float]:
    """Cover a box, its centre at the origin, with equal spheres, one for each of its cells.

    The cells are about as long as the shortest side, but at most three lie along any side.

    Args:
        size: Full side lengths x, y, z in metres.

    Returns:
        Centres (K, 3) and the radius.
    """
    counts = [min(3, math.ceil(side / min(size) - 0.5)) for side in size]
    cell = np.array(size) / counts
    axes = [(np.arange(count) - (count - 1) / 2) * side for count, side in zip(counts, cell, strict=True)]
    centres = np.stack(np.meshgrid(*axes, indexing="ij"), axis=-1).reshape(-1, 3)
    return centres, float(np.linalg.norm(cell)) / 2


def enclosing_sphere(points: Array, steps: int = 40) -> tuple[Array, float]:
    """A small sphere, (centre (3,), radius), around points (V, 3): the optimum but for about 1 / `steps`.

    Bădoiu and Clarkson, "Smaller core-sets for balls", SODA 2003: step to the farthest point, ever more carefully.
    """
    centre = (points.min(axis=0) + points.max(axis=0)) / 2
    for i in range(1, steps + 1):
        farthest = points[np.argmax(np.sum((points - centre) ** 2, axis=1))]
        centre = centre + (farthest - centre) / (i + 1)
    return centre, float(np.linalg.norm(points - centre, axis=1).max())


def _cover_along(axis: Array, points: Array, edges: NDArray[np.int32], slab: float) -> tuple[Array, Array]:
    heights = points @ axis
    low, high = float(heights.min()), float(heights.max())
    cuts = np.linspace(low, high, max(1, math.ceil((high - low) / slab)) + 1)
    spheres = []
    for bottom, top in pairwise(cuts):
        inside = points[(heights >= bottom - 1e-9) & (heights <= top + 1e-9)]
        # The hull within a slab is the hull of its corners there and of the points where edges leave the slab.
        piece = np.concatenate([inside, *(_crossings(points, heights, edges, cut) for cut in (bottom, top))])
        spheres.append(enclosing_sphere(piece))
    return np.array([centre for centre, _ in spheres]), np.array([radius for _, radius in spheres])


def _crossings(points: Array, heights: Array, edges: NDArray[np.int32], cut: float) -> Array:
    """Where edges cross the plane at a height."""
    a, b = edges.T
    crossing = (heights[a] - cut) * (heights[b] - cut) < 0
    a, b = a[crossing], b[crossing]
    share = (cut - heights[a]) / (heights[b] - heights[a])
    crossed: Array = points[a] + share[:, None] * (points[b] - points[a])
    return crossed
