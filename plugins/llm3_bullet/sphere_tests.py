"""Which spheres come near which boxes and which other spheres, for many configurations at once, in numpy.

Positions of S spheres in N configurations are homogeneous here, (N, 4, S), as `Kinematics.placement` makes them. They
may have single precision: both tests leave room for its rounding.
"""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np
from numpy.typing import NDArray

from llm3_bullet.poses import as_matrix
from llm3_bullet.scene import Box

Array = NDArray[np.float64]
Single = NDArray[np.floating]
Mask = NDArray[np.bool_]

ROUNDING = 16 * float(np.finfo(np.float32).eps)
"""Relative error that a few operations in single precision may add up to."""


class SpheresAgainstBoxes:
    """Spheres that move among boxes that do not."""

    def __init__(self, radii: Array, boxes: Sequence[Box], exempt: Mask, clearance: float) -> None:
        """Prepare the test.

        Args:
            radii: (S,) in metres.
            boxes: B boxes.
            exempt: (B, S): which spheres may touch which boxes.
            clearance: In metres; what is closer is near.
        """
        count = len(radii)
        poses = np.array([as_matrix(box.pose) for box in boxes]).reshape(-1, 4, 4)
        frames = np.zeros((len(boxes), 4, 4))
        frames[:, :3, :3] = poses[:, :3, :3].swapaxes(1, 2)
        frames[:, :3, 3] = -(frames[:, :3, :3] @ poses[:, :3, 3:])[:, :, 0]
        halves = np.array([box.size for box in boxes]).reshape(-1, 3) / 2
        rounding = ROUNDING * (np.abs(frames[:, :3, 3]).max(axis=1, initial=1.0) + halves.max(axis=1, initial=0.0))
        limits = np.maximum(radii + clearance + rounding[:, None], 0.0) ** 2
        # All x axes, all y axes, all z axes; constants are repeated for each sphere, so that numpy has one long loop.
        self._axes = frames[:, :3].transpose(1, 0, 2).reshape(-1, 4).astype(np.float32)
        self._halves = np.repeat(halves.T, count, axis=1).astype(np.float32)
        self._limits = np.where(exempt, -1.0, limits).astype(np.float32).ravel()
        self._shape = len(boxes), count

    def near(self, centres: Single) -> Mask:
        """Which boxes which spheres may be closer to than the clearance, (N, B, S)."""
        return (self._squared(centres) <= self._limits).reshape(len(centres), *self._shape)

    def gaps(self, centres: Single) -> Single:
        """How much farther apart than the clearance they certainly are, (N, B, S) in metres; infinite where exempt."""
        gaps = np.sqrt(self._squared(centres))
        gaps -= np.where(self._limits < 0, -np.inf, np.sqrt(np.abs(self._limits)))
        return gaps.reshape(len(centres), *self._shape)

    def _squared(self, centres: Single) -> Single:
        """The squared distances of the spheres' centres from the boxes, (N, B S)."""
        offsets = (self._axes @ centres).reshape(len(centres), *self._halves.shape)
        np.abs(offsets, out=offsets)
        offsets -= self._halves
        np.maximum(offsets, 0.0, out=offsets)
        return _squared(offsets)


class SpheresAgainstSpheres:
    """Spheres that must not come near each other."""

    def __init__(self, radii: Array, tested: Mask, clearance: float, extent: float) -> None:
        """Prepare the test.

        Args:
            radii: (S,) in metres.
            tested: (S, S): which spheres are tested against which.
            clearance: In metres; what is closer is near.
            extent: How far a sphere can be from the world's origin, in metres.
        """
        rows, columns = np.flatnonzero(tested.any(axis=1)), np.flatnonzero(tested.any(axis=0))
        self.rows = slice(0, rows.max(initial=-1) + 1)
        """The spheres that `near` has rows for …"""
        self.columns = slice(columns.min(initial=len(radii)), len(radii))
        """… and those it has columns for."""
        limits = np.maximum(radii[:, None] + radii + clearance, 0.0) ** 2 + ROUNDING * extent**2
        self._limits = np.where(tested, limits, -np.inf).astype(np.float32)[self.rows, self.columns]

    def near(self, centres: Single) -> Mask:
        """Which spheres may be closer to which than the clearance, (N, rows, columns)."""
        mask: Mask = self._squared(centres) <= self._limits
        return mask

    def gaps(self, centres: Single) -> Single:
        """How much farther apart than the clearance they certainly are, (N, rows, columns); infinite if not tested."""
        gaps = np.sqrt(np.maximum(self._squared(centres), 0.0))
        gaps -= np.where(np.isfinite(self._limits), np.sqrt(np.maximum(self._limits, 0.0)), -np.inf)
        return gaps

    def _squared(self, centres: Single) -> Single:
        """The squared distances between the centres, (N, rows, columns)."""
        # |a - b|² = (-2 a, |a|², 1) · (b, 1, |b|²), all pairs in one product.
        norms = _squared(centres[:, :3])
        a = np.empty((len(centres), 5, self._limits.shape[0]), np.float32)
        b = np.empty((len(centres), 5, self._limits.shape[1]), np.float32)
        np.multiply(centres[:, :3, self.rows], -2.0, out=a[:, :3])
        a[:, 3], a[:, 4] = norms[:, self.rows], 1.0
        b[:, :4], b[:, 4] = centres[:, :, self.columns], norms[:, self.columns]
        distances: Single = a.swapaxes(1, 2) @ b
        return distances


def _squared(vectors: Single) -> Single:
    """The squared lengths of vectors (N, 3, ...): a sum of three arrays, faster than a reduction of one."""
    squares = vectors * vectors
    total: Single = squares[:, 0] + squares[:, 1]
    total += squares[:, 2]
    return total
