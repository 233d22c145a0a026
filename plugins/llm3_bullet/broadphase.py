"""What certainly touches nothing, for many configurations at once, in numpy.

A sphere that stays clear of a box keeps the part of a link inside it clear. What is cleared here is clear for PyBullet
too; what is not cleared may still be clear. As in `link_spheres`, arrays have the configurations last.
"""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np
from numpy.typing import NDArray

from llm3_bullet.link_spheres import TOLERANCE, LinkSpheres, PlacedSpheres
from llm3_bullet.poses import as_matrix
from llm3_bullet.scene import Scene
from llm3_bullet.self_collision import NeighbourClearance, Pair

Array = NDArray[np.float64]
Mask = NDArray[np.bool_]


class SelfClearance:
    """Which pairs of links are certainly apart."""

    def __init__(self, spheres: LinkSpheres, pairs: Sequence[Pair], neighbours: NeighbourClearance) -> None:
        distant = [pair for pair in pairs if pair not in set(neighbours.pairs)]
        self.pairs = (*neighbours.pairs, *distant)
        """All pairs, in the order in which `open` answers."""
        self._neighbours, self._spheres = neighbours, spheres
        self._ends = np.searchsorted(spheres.links, np.array(distant, dtype=np.intp).reshape(-1, 2))

    def open(self, Q: Array, placed: PlacedSpheres, clearance: float) -> Mask:
        """Which pairs (P, N) may be closer than the clearance in configurations (N, dof)."""
        near = clearance + TOLERANCE >= self._neighbours.bounds(Q).T
        spheres, (a, b) = self._spheres, self._ends.T
        limit = (spheres.whole_radius[a] + spheres.whole_radius[b] + clearance) ** 2
        far = _squared(placed.wholes[:, a] - placed.wholes[:, b]) <= limit[:, None]
        for pair in np.flatnonzero(far.any(axis=1)):
            which = np.flatnonzero(far[pair])
            slabs_a, slabs_b = (spheres.slabs_of[end] for end in self._ends[pair])
            apart = placed.slabs[:, slabs_a, None, which] - placed.slabs[:, None, slabs_b, which]
            limits = (spheres.radius[slabs_a, None] + spheres.radius[slabs_b] + clearance) ** 2
            far[pair, which] = (_squared(apart) <= limits[:, :, None]).any(axis=(0, 1))
        return np.concatenate([near, far])


class BoxClearance:
    """Which boxes of a scene are certainly clear of the robot."""

    def __init__(self, scene: Scene, spheres: LinkSpheres, mounted: Sequence[int]) -> None:
        frames = np.array([as_matrix(box.pose) for box in scene.boxes]).reshape(-1, 4, 4)
        self._axes = frames[:, :3, :3].transpose(2, 0, 1).reshape(-1, 3)  # all x axes, all y axes, all z axes
        self._origins = np.einsum("abi,bi->ab", self._axes.reshape(3, -1, 3), frames[:, :3, 3])
        self._halves = np.array([box.size for box in scene.boxes]).reshape(-1, 3).T / 2
        fixed = np.array([box.fixed for box in scene.boxes], dtype=bool)
        standing = np.repeat(np.isin(spheres.links, mounted), [s.stop - s.start for s in spheres.slabs_of])
        self._exempt = fixed[:, None] & standing
        self._radius = spheres.radius

    def robot_open(self, placed: PlacedSpheres, clearance: float) -> Mask:
        """Which boxes (B, N) the robot may be closer to than the clearance."""
        offsets = self.along_axes(placed.slabs.reshape(3, -1))
        np.abs(offsets, out=offsets)
        offsets -= self._halves[:, :, None]
        np.maximum(offsets, 0.0, out=offsets)
        limits = np.where(self._exempt, -1.0, (self._radius + clearance) ** 2)
        near = _squared(offsets).reshape(len(limits), *placed.slabs.shape[1:]) <= limits[:, :, None]
        touched: Mask = np.logical_or.reduce(near, axis=1)
        return touched

    def box_open(self, held: Array, half: Array, clearance: float) -> Mask:
        """Which boxes (B, N) a held one may be closer to than the clearance: no face of either parts the two.

        Args:
            held: The held box's frame by columns, (4, 3, N).
            half: Half of its sides, (3,).
            clearance: In metres.
        """
        offset = self.along_axes(held[3])  # (3, B, N), in the frame of the scene's boxes
        turn = (self._axes @ held[:3].swapaxes(0, 1).reshape(3, -1)).reshape(*offset.shape[:2], 3, held.shape[2])
        on_held = np.abs((turn * offset[:, :, None]).sum(axis=0))  # (B, 3, N)
        np.abs(turn, out=turn)
        on_held -= half[:, None] + (turn * self._halves[:, :, None, None]).sum(axis=0)
        on_box = np.abs(offset) - self._halves[:, :, None] - (turn * half[:, None]).sum(axis=2)
        gap: Array = np.maximum(on_box.max(axis=0), on_held.max(axis=1))
        return gap <= clearance + TOLERANCE

    def along_axes(self, points: Array) -> Array:
        """World points (3, M) in each box's frame: (3, B, M)."""
        offsets = (self._axes @ points).reshape(*self._halves.shape, points.shape[1])
        offsets -= self._origins[:, :, None]
        return offsets


def held_open(
    held: Array, half: Array, spheres: LinkSpheres, placed: PlacedSpheres, links: Sequence[int], clearance: float
) -> Mask:
    """Which links (len(links), N) a held box may be closer to than the clearance; see `BoxClearance.box_open`."""
    numbers = np.searchsorted(spheres.links, links)
    reach = float(np.linalg.norm(half)) + clearance
    near = (
        _squared(placed.wholes[:, numbers] - held[3][:, None]) <= ((spheres.whole_radius + reach) ** 2)[numbers, None]
    )
    for row in np.flatnonzero(near.any(axis=1)):
        which = np.flatnonzero(near[row])
        slabs = spheres.slabs_of[numbers[row]]
        offsets = placed.slabs[:, slabs, which] - held[3][:, None, which]
        local = np.einsum("isn,ain->asn", offsets, held[:3, :, which])
        beyond = np.maximum(np.abs(local) - half[:, None, None], 0.0)
        limit = (spheres.radius[slabs, None] + clearance) ** 2
        near[row, which] = (_squared(beyond) <= limit).any(axis=0)
    return near


def _squared(vectors: Array) -> Array:
    """The squared lengths of vectors (3, ...): a sum of three arrays, faster than a reduction of one."""
    x, y, z = vectors
    total: Array = x * x
    total += y * y
    total += z * z
    return total
