"""A robot's links covered by spheres, placed for many configurations at once.

Arrays here have the configurations last: (3, S, N) are the centres of S spheres in N configurations.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from llm3_bullet.hulls import MARGIN
from llm3_bullet.spheres import cover, enclosing_sphere

Array = NDArray[np.float64]

TOLERANCE = 2e-4
"""Metres that PyBullet's distances may be short of the truth."""


@dataclass(frozen=True, eq=False)
class PlacedSpheres:
    """The spheres in N configurations, world frame, in metres."""

    slabs: Array
    """(3, S, N): centres of the spheres that each cover a slab of a link."""
    wholes: Array
    """(3, K, N): centres of the spheres that each cover a whole link."""


class LinkSpheres:
    """For each solid link one sphere around all of it, and several around its slabs, PyBullet's margin included."""

    def __init__(self, hulls: Sequence[Array], slab: float = 0.06) -> None:
        """Cover the links.

        Args:
            hulls: For each link, in the model's order, points (V, 3) in its frame whose convex hull covers it.
            slab: Greatest thickness of a slab in metres.
        """
        self.links = np.array([link for link, hull in enumerate(hulls) if len(hull)], dtype=np.intp)
        """(K,): the links that have a shape."""
        covers = [cover(hulls[link], slab) for link in self.links]
        wholes = [enclosing_sphere(hulls[link]) for link in self.links]
        counts = [len(radii) for _, radii in covers]
        ends = np.cumsum(counts)
        self.slabs_of = [slice(end - count, end) for end, count in zip(ends.tolist(), counts, strict=True)]
        """For each solid link the slice of S that is its own."""
        self.radius = np.concatenate([radii for _, radii in covers]) + MARGIN + TOLERANCE
        """(S,)"""
        self.whole_radius = np.array([radius for _, radius in wholes]) + MARGIN + TOLERANCE
        """(K,)"""
        # All links in one matrix product: each has as many rows as the one with the most slabs, and one more.
        padded = np.zeros((len(covers), max(counts) + 1, 4))
        padded[:, :, 3] = 1.0
        for rows, (centres, _), (centre, _) in zip(padded, covers, wholes, strict=True):
            rows[: len(centres), :3] = centres
            rows[-1, :3] = centre
        self._padded = padded
        width = padded.shape[1]
        self._slab_rows = np.concatenate([np.arange(count) + k * width for k, count in enumerate(counts)])
        self._whole_rows = np.arange(1, len(covers) + 1) * width - 1

    def place(self, columns: Array) -> PlacedSpheres:
        """Place the spheres for link frames given as columns, (L, 4, 3, N)."""
        placed = self._padded @ columns[self.links].reshape(len(self.links), 4, -1)
        placed = placed.reshape(-1, 3, columns.shape[3]).swapaxes(0, 1)
        return PlacedSpheres(placed[:, self._slab_rows], placed[:, self._whole_rows])


def as_columns(frames: Array) -> Array:
    """Homogeneous transforms (N, ..., 4, 4) as their columns x, y, z and origin, (..., 4, 3, N)."""
    return np.ascontiguousarray(np.moveaxis(frames[..., :3, :], 0, -1).swapaxes(-3, -2))
