"""What certainly touches nothing, for many configurations at once, in numpy.

A sphere that stays clear of a box keeps the part of a link inside it clear. What is cleared here is clear for PyBullet
too; what is not cleared may still be clear, and is left as a question for PyBullet.
"""

from __future__ import annotations

from collections import defaultdict
from collections.abc import Sequence
from functools import lru_cache, partial

import numpy as np
from numpy.typing import NDArray

from llm3_bullet.hulls import MARGIN
from llm3_bullet.kinematics import Kinematics
from llm3_bullet.link_spheres import TOLERANCE, spheres_of_held, spheres_of_links
from llm3_bullet.narrowphase import Questions
from llm3_bullet.reach import extent, joints_below
from llm3_bullet.scene import HeldBox, Scene
from llm3_bullet.self_collision import NeighbourClearance, Pair
from llm3_bullet.sphere_tests import Mask, Single, SpheresAgainstBoxes, SpheresAgainstSpheres

Array = NDArray[np.float64]

_SLACK = 1e-4  # metres that single precision may lose in a gap
_STILL = 1e-9  # keeps divisions by the travel of what does not move defined
_KEPT = 256  # openings and held boxes whose spheres are remembered


class RobotCover:
    """What the coarse tests know about a robot, whatever surrounds it."""

    def __init__(
        self,
        kinematics: Kinematics,
        hulls: Sequence[Array],
        pairs: Sequence[Pair],
        neighbours: NeighbourClearance,
        arm_links: Sequence[int],
        mounted_links: Sequence[int],
    ) -> None:
        """Cover the robot with spheres.

        Args:
            kinematics: Where its links are.
            hulls: For each link points (V, 3) in its frame whose convex hull covers it.
            pairs: The pairs of links that may not touch.
            neighbours: What tells some of these pairs apart that are always near each other.
            arm_links: The links that a held box may not touch.
            mounted_links: The links that may touch what is fixed.
        """
        self.kinematics = Kinematics(kinematics.model, np.float32)
        self.spheres = spheres_of_links(hulls)
        self.neighbours = neighbours
        self.distant = [pair for pair in pairs if pair not in set(neighbours.pairs)]
        self.arm_links, self.mounted_links = arm_links, mounted_links
        self.extent = extent(kinematics) + max(np.linalg.norm(hull, axis=1).max(initial=0.0) for hull in hulls) + MARGIN
        self.moving = lru_cache(_KEPT)(partial(_Moving, self))
        """What moves at an opening, with a held box, and the clearance that it keeps from itself."""


class _Moving:
    """The robot's spheres and those of what it holds, whatever stands around."""

    def __init__(self, cover: RobotCover, opening: float, held_box: HeldBox | None, clearance: float) -> None:
        model = cover.kinematics.model
        held = spheres_of_held(held_box, model.tool)
        held_number = len(model.links)
        bodies = np.concatenate([cover.spheres.links, np.full(len(held.links), held_number)])
        tested = np.zeros((held_number + 1, held_number + 1), dtype=bool)
        tested[tuple(np.array(cover.distant, dtype=np.intp).reshape(-1, 2).T)] = True
        tested[cover.arm_links, held_number] = True
        reach = cover.extent + np.linalg.norm(held.centres, axis=1).max(initial=0.0)
        self.bodies = bodies
        self.radii = np.concatenate([cover.spheres.radii, held.radii])
        self.mounted = np.isin(bodies, cover.mounted_links)
        self.joints = joints_below(model)[np.where(bodies == held_number, model.tool, bodies)]
        """For each sphere the number of arm joints that move it."""
        self.placement = cover.kinematics.placement(
            np.concatenate([cover.spheres.links, held.links]),
            np.concatenate([cover.spheres.centres, held.centres]),
            opening,
        )
        self.pairs = SpheresAgainstSpheres(self.radii, tested[np.ix_(bodies, bodies)], clearance, reach)


class Broadphase:
    """The coarse tests for one scene and one clearance."""

    def __init__(self, cover: RobotCover, scene: Scene, clearance: float) -> None:
        self._cover, self._clearance = cover, clearance
        self._moving = cover.moving(scene.opening, scene.held, clearance)
        fixed = np.array([box.fixed for box in scene.boxes], dtype=bool)
        exempt = fixed[:, None] & self._moving.mounted
        self._boxes = SpheresAgainstBoxes(self._moving.radii, scene.boxes, exempt, clearance)

    def left_open(self, Q: Array) -> list[tuple[int, Questions]]:
        """The configurations (N, dof), within the limits, that are not certainly clear: what is left to be asked."""
        cover, moving = self._cover, self._moving
        centres = self._centres(Q)
        questions: defaultdict[int, Questions] = defaultdict(Questions)
        near = self._near_neighbours(Q)
        if np.count_nonzero(near):
            for row, pair in np.argwhere(near).tolist():
                questions[row].pairs.append(cover.neighbours.pairs[pair])
        near = moving.pairs.near(centres)
        if np.count_nonzero(near):
            rows, a, b = _indices(near)
            for row, one, other in sorted(_distinct(rows, moving.bodies[a], moving.bodies[moving.pairs.columns][b])):
                questions[row].pairs.append((one, other))
        near = self._boxes.near(centres)
        if np.count_nonzero(near):
            rows, boxes, spheres = _indices(near)
            for row, box, body in sorted(_distinct(rows, boxes, moving.bodies[spheres])):
                questions[row].boxes.append((box, body))
        return list(questions.items())

    def certain_steps(self, Q: Array, travel: Array) -> Array:
        """For how many steps of any straight line configurations (N, dof) certainly stay clear, neighbours aside.

        Args:
            Q: Within the limits.
            travel: How far each joint moves anything in a step, in metres, (dof,).

        Returns:
            (N,); less than 0 for a configuration that may not be clear itself.
        """
        moving, centres = self._moving, self._centres(Q)
        moved = np.concatenate([[0.0], np.cumsum(travel)])[moving.joints].astype(np.float32) + _STILL
        against_boxes = ((self._boxes.gaps(centres) - _SLACK) / moved).min(axis=(1, 2), initial=np.inf)
        pairs = moving.pairs
        between = np.abs(moved[pairs.columns] - moved[pairs.rows, None]) + _STILL
        against_itself = ((pairs.gaps(centres) - _SLACK) / between).min(axis=(1, 2), initial=np.inf)
        certain: Array = np.minimum(against_boxes, against_itself)
        return certain

    def neighbours_clear(self, Q: Array) -> Mask:
        """Whether the pairs of links that are near each other always certainly keep the clearance, (N,)."""
        clear: Mask = np.logical_not(self._near_neighbours(Q).any(axis=1))
        return clear

    def _near_neighbours(self, Q: Array) -> Mask:
        near: Mask = self._cover.neighbours.bounds(Q) <= self._clearance + TOLERANCE
        return near

    def _centres(self, Q: Array) -> Single:
        """Where the spheres are, homogeneous, (N, 4, S)."""
        frames = self._cover.kinematics.joint_frames(Q)
        return (frames.reshape(4 * len(Q), -1) @ self._moving.placement).reshape(len(Q), 4, -1)


def _indices(mask: NDArray[np.bool_]) -> tuple[NDArray[np.intp], ...]:
    """Where the mask is true, an array for each axis; much faster than `numpy.nonzero` where it is hardly ever true."""
    return np.unravel_index(np.flatnonzero(mask), mask.shape)


def _distinct(*columns: NDArray[np.intp]) -> set[tuple[int, ...]]:
    """The rows of a table that is given by its columns, each once."""
    return set(zip(*(column.tolist() for column in columns), strict=True))
