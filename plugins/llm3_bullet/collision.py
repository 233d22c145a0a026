"""Is the robot free? A fast and exact answer for many configurations, and reasons for a single one.

A coarse test in numpy clears most configurations, and PyBullet answers for the rest. The verdict is PyBullet's in
either case, and it depends on the configuration and the scene alone, never on what was asked before.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from typing import TypeVar

import numpy as np
from numpy.typing import NDArray

from llm3.types import Contact
from llm3_bullet.broadphase import BoxClearance, SelfClearance, held_open
from llm3_bullet.clients import BulletClient
from llm3_bullet.hulls import MARGIN, link_hull
from llm3_bullet.kinematics import Kinematics
from llm3_bullet.link_spheres import LinkSpheres, as_columns
from llm3_bullet.model import RobotModel
from llm3_bullet.narrowphase import Narrowphase, Questions
from llm3_bullet.poses import as_matrix, quaternions
from llm3_bullet.reach import reach
from llm3_bullet.scene import Scene
from llm3_bullet.self_collision import NeighbourClearance, link_pairs

Array = NDArray[np.float64]
Mask = NDArray[np.bool_]
T = TypeVar("T")

BATCH = 1024
"""Configurations that are tested together at most, which bounds the memory."""


class CollisionChecker:
    """A robot in a PyBullet world, ready to be looked at in any scene."""

    def __init__(self, client: BulletClient, model: RobotModel, kinematics: Kinematics) -> None:
        """Load the robot and prepare the coarse tests.

        Args:
            client: A world that nothing else uses.
            model: The robot.
            kinematics: Its kinematics.
        """
        self.kinematics = kinematics
        self.narrowphase = Narrowphase(client, model)
        self.hulls = [link_hull(client, self.narrowphase.robot, link - 1) for link in range(len(model.links))]
        self.spheres = LinkSpheres(self.hulls)
        solid: list[int] = self.spheres.links.tolist()
        pairs = link_pairs(model, solid)
        neighbours = NeighbourClearance(kinematics, self.hulls, pairs, self.narrowphase.link_distance)
        self.self_clearance = SelfClearance(self.spheres, pairs, neighbours)
        gripper = {model.link(name) for name in model.description.gripper.links}
        self.arm_links = [link for link in solid if link not in gripper]
        self.mounted_links = [model.link(name) for name in model.description.mounted_links]

    def view(self, scene: Scene) -> SceneChecker:
        """The checker for one scene; many of them may be in use at once."""
        return SceneChecker(self, scene)


@dataclass(frozen=True, eq=False)
class _Open:
    """What the coarse tests leave open for N configurations, each (N, number of things)."""

    boxes: Mask
    pairs: Mask
    held_boxes: Mask
    held_links: Mask

    def rows(self) -> NDArray[np.intp]:
        """The configurations for which anything is open."""
        left = self.boxes.any(axis=1) | self.pairs.any(axis=1)
        return np.flatnonzero(left | self.held_boxes.any(axis=1) | self.held_links.any(axis=1))


class SceneChecker:
    """Verdicts for one scene. It stays right when other scenes were looked at in between."""

    def __init__(self, checker: CollisionChecker, scene: Scene) -> None:
        self._checker = checker
        self._clearance = BoxClearance(scene, checker.spheres, checker.mounted_links)
        self._grasp = as_matrix(scene.held.grasp) if scene.held else None
        self._half = np.array(scene.held.size) / 2 if scene.held else np.zeros(3)
        self.scene = scene
        self.checks = 0
        """The number of configurations tested so far."""

    def valid(self, Q: Array, clearance: float = 0.0, coarse: bool = True) -> Mask:
        """Which configurations are within the joint limits and free of collisions.

        Args:
            Q: Configurations, (N, dof).
            clearance: Nothing may come closer than this, in metres; negative to let things penetrate so far.
            coarse: Let numpy clear what it can; without it PyBullet answers alone, slowly, and the same.

        Returns:
            (N,)
        """
        Q = np.asarray(Q, dtype=float)
        self.checks += len(Q)
        mask = self._checker.kinematics.model.within_limits(Q)
        self._checker.narrowphase.show(self.scene)
        inside = np.flatnonzero(mask)
        for start in range(0, len(inside), BATCH):
            batch = inside[start : start + BATCH]
            mask[batch] = self._free(Q[batch], clearance, coarse)
        return mask

    def contacts(self, q: Array, clearance: float = 0.0) -> tuple[Contact, ...]:
        """What touches what in a configuration (dof,), or comes closer than the clearance: the deepest first.

        Of all places where a part touches an object, the deepest stands for the contact.
        """
        self.checks += 1
        self._checker.narrowphase.show(self.scene)
        Q = np.asarray(q, dtype=float)[None]
        held = self._held(self._frames(Q))
        found = next(self._answers(Q, held, self._everything(1), np.array([0]), clearance))
        deepest: dict[tuple[str, str], Contact] = {}
        for contact in sorted(found, key=lambda contact: -contact.depth):
            deepest.setdefault((contact.part, contact.object), contact)
        return tuple(deepest.values())

    def resolution(self, clearance: float) -> Array:
        """Steps (dof,) between samples of an edge that let nothing slip through between two of them.

        Between two configurations with Σ|Δq_j| / resolution_j ≤ 1 no point of the robot or the held box travels
        farther than twice the clearance.

        Raises:
            ValueError: The clearance is not positive.
        """
        if not clearance > 0:
            raise ValueError(f"a sampling step needs a positive clearance in metres, not {clearance}")
        points = list(self._checker.hulls)
        tool = self._checker.kinematics.model.tool
        if self._grasp is not None:
            signs = np.array(np.meshgrid(*[[-1, 1]] * 3)).reshape(3, -1).T
            corners = (signs * self._half) @ self._grasp[:3, :3].T + self._grasp[:3, 3]
            points[tool] = np.concatenate([points[tool], corners])
        travel = reach(self._checker.kinematics, points, self.scene.opening) + MARGIN
        return 2 * clearance / travel

    def _free(self, Q: Array, clearance: float, coarse: bool) -> Mask:
        frames = self._frames(Q)
        held = self._held(frames)
        open_ = self._left_open(Q, frames, held, clearance) if coarse else self._everything(len(Q))
        rows = open_.rows()
        free = np.ones(len(Q), dtype=bool)
        answers = self._answers(Q, held, open_, rows, clearance)
        free[rows] = [next(found, None) is None for found in answers]
        return free

    def _frames(self, Q: Array) -> Array:
        return self._checker.kinematics.link_frames(Q, self.scene.opening)

    def _held(self, frames: Array) -> Array | None:
        """World frames (N, 4, 4) of the held box."""
        return None if self._grasp is None else frames[:, self._checker.kinematics.model.tool] @ self._grasp

    def _left_open(self, Q: Array, frames: Array, held: Array | None, clearance: float) -> _Open:
        checker = self._checker
        placed = checker.spheres.place(as_columns(frames))
        boxes = self._clearance.robot_open(placed, clearance).T
        pairs = checker.self_clearance.open(Q, placed, clearance).T
        if held is None:
            nothing = np.zeros((len(Q), 0), dtype=bool)
            return _Open(boxes, pairs, nothing, nothing)
        columns = as_columns(held)
        held_boxes = self._clearance.box_open(columns, self._half, clearance).T
        held_links = held_open(columns, self._half, checker.spheres, placed, checker.arm_links, clearance).T
        return _Open(boxes, pairs, held_boxes, held_links)

    def _everything(self, count: int) -> _Open:
        boxes = np.ones((count, len(self.scene.boxes)), dtype=bool)
        return _Open(
            boxes=boxes,
            pairs=np.ones((count, len(self._checker.self_clearance.pairs)), dtype=bool),
            held_boxes=boxes,
            held_links=np.ones((count, len(self._checker.arm_links)), dtype=bool),
        )

    def _answers(
        self, Q: Array, held: Array | None, open_: _Open, rows: NDArray[np.intp], clearance: float
    ) -> Iterator[Iterator[Contact]]:
        """The contacts of each of these rows, to be consumed one row after the other."""
        pairs, links = self._checker.self_clearance.pairs, self._checker.arm_links
        orientations = None if held is None or not len(rows) else quaternions(held[rows])
        for i, row in enumerate(rows):
            questions = Questions(
                boxes=_chosen(range(len(self.scene.boxes)), open_.boxes[row]),
                pairs=_chosen(pairs, open_.pairs[row]),
                held_boxes=_chosen(range(len(self.scene.boxes)), open_.held_boxes[row]),
                held_links=_chosen(links, open_.held_links[row]),
            )
            pose = None if held is None or orientations is None else (held[row, :3, 3], orientations[i])
            yield self._checker.narrowphase.contacts(Q[row], pose, questions, clearance)


def _chosen(things: Sequence[T], mask: Mask) -> list[T]:
    return [things[i] for i in np.flatnonzero(mask).tolist()]
