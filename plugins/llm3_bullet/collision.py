"""Is the robot free? A fast and exact answer for many configurations, and reasons for a single one.

Coarse tests clear most configurations, in numpy where there are many and in PyBullet's collision step where there are
one or two, and PyBullet's closest-point queries answer for the rest. The verdict is that of the queries in either case,
and it depends on the configuration and the scene alone, never on what was asked before.
"""

from __future__ import annotations

from collections.abc import Sequence
from functools import lru_cache
from itertools import product

import numpy as np
from numpy.typing import NDArray

from llm3.types import Contact
from llm3_bullet.broadphase import Broadphase, RobotCover
from llm3_bullet.clients import BulletClient
from llm3_bullet.hulls import MARGIN, link_hull
from llm3_bullet.kinematics import Kinematics
from llm3_bullet.model import RobotModel
from llm3_bullet.narrowphase import Narrowphase, Questions
from llm3_bullet.poses import as_matrix
from llm3_bullet.reach import reach
from llm3_bullet.scene import HeldBox, Scene
from llm3_bullet.self_collision import NeighbourClearance, link_pairs
from llm3_bullet.thick_world import LARGEST_CLEARANCE, THICKNESS, ThickWorld

Array = NDArray[np.float64]
Mask = NDArray[np.bool_]

FEW = 2
"""Configurations that PyBullet's collision step clears sooner than numpy starts up for all of them."""
LIMIT_TOLERANCE = 1e-9
"""What counts as within the joint limits, in radians or metres."""
STRIDE = 12
"""Samples of a line from one look for room to the next."""
_KEPT = 256  # grasps whose reach is remembered
BATCH = 256
"""Configurations that are tested together at most: so many fit into a processor's cache."""


class CollisionChecker:
    """A robot in a PyBullet world, ready to be looked at in any scene."""

    def __init__(
        self,
        client: BulletClient,
        model: RobotModel,
        kinematics: Kinematics,
        step_client: BulletClient | None = None,
    ) -> None:
        """Load the robot and prepare the coarse tests.

        Args:
            client: A world that nothing else uses.
            model: The robot.
            kinematics: Its kinematics.
            step_client: Another world that nothing else uses, for PyBullet's collision step. Without it, the first
                serves both, and the verdict on a single configuration takes a little longer.
        """
        self.kinematics = kinematics
        self.narrowphase = Narrowphase(client, model)
        self.hulls = [link_hull(client, self.narrowphase.robot, link - 1) for link in range(len(model.links))]
        self.links = [link for link, hull in enumerate(self.hulls) if len(hull)]
        """The links that have a collision shape."""
        self.pairs = link_pairs(model, self.links)
        """The pairs of links whose contact is a collision."""
        gripper = {model.link(name) for name in model.description.gripper.links}
        self.arm_links = [link for link in self.links if link not in gripper]
        """The links that a held box must not touch."""
        self.mounted_links = [model.link(name) for name in model.description.mounted_links]
        """The links that may touch what is fixed."""
        neighbours = NeighbourClearance(kinematics, self.hulls, self.pairs, self.narrowphase.link_distance)
        within_reach = [pair for pair in self.pairs if neighbours.least.get(pair, 0.0) <= THICKNESS]
        self.thick_world = ThickWorld(step_client or client, model, self.hulls, within_reach)
        self.cover = RobotCover(kinematics, self.hulls, self.pairs, neighbours, self.arm_links, self.mounted_links)
        self.travel = lru_cache(_KEPT)(self._travel)
        """What `reach` says of the robot at an opening and with a held box: (dof,)."""

    def view(self, scene: Scene) -> SceneChecker:
        """The checker for one scene; many of them may be in use at once."""
        return SceneChecker(self, scene)

    def _travel(self, opening: float, held: HeldBox | None) -> Array:
        points = list(self.hulls)
        if held is not None:
            grasp, tool = as_matrix(held.grasp), self.kinematics.model.tool
            corners = np.array(list(product((-0.5, 0.5), repeat=3))) * held.size
            points[tool] = np.concatenate([points[tool], corners @ grasp[:3, :3].T + grasp[:3, 3]])
        return reach(self.kinematics, points, opening) + MARGIN


class SceneChecker:
    """Verdicts for one scene. It stays right when other scenes were looked at in between."""

    def __init__(self, checker: CollisionChecker, scene: Scene) -> None:
        self._checker = checker
        self._model = checker.kinematics.model
        self._low, self._high = self._model.low - LIMIT_TOLERANCE, self._model.high + LIMIT_TOLERANCE
        self._lowest, self._highest = self._low.tolist(), self._high.tolist()
        self._grasp = as_matrix(scene.held.grasp) if scene.held else None
        self._coarse: dict[float, Broadphase] = {}
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
        if len(Q) <= FEW and coarse and clearance <= LARGEST_CLEARANCE:
            return np.array([self._is_free(q, clearance) for q in Q.tolist()], dtype=bool)
        inside = (self._low <= Q) & (self._high >= Q)
        if np.count_nonzero(inside) == inside.size and 0 < len(Q) <= BATCH:
            return self._free(Q, clearance, coarse)
        mask: Mask = np.asarray(inside.all(axis=1))
        rows = np.flatnonzero(mask)
        for start in range(0, len(rows), BATCH):
            batch = rows[start : start + BATCH]
            mask[batch] = self._free(Q[batch], clearance, coarse)
        return mask

    def contacts(self, q: Array, clearance: float = 0.0) -> tuple[Contact, ...]:
        """What touches what in a configuration (dof,), or comes closer than the clearance: the deepest first.

        Of all places where a link, or the held box, touches an object or another link, the deepest stands for them.
        """
        self.checks += 1
        q = np.asarray(q, dtype=float)
        inside = bool(((self._low <= q) & (self._high >= q)).all())
        left = self._broadphase(clearance).left_open(q[None]) if inside else [(0, self._everything())]
        if not left:
            return ()
        narrowphase = self._checker.narrowphase
        narrowphase.show(self.scene)
        found = narrowphase.contacts(q, left[0][1], clearance)
        deepest: dict[tuple[str, ...], Contact] = {}
        for contact in sorted(found, key=lambda contact: -contact.depth):
            deepest.setdefault((contact.part, contact.link, contact.object, contact.other_link), contact)
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
        travel: Array = self._checker.travel(self.scene.opening, self.scene.held)
        return 2 * clearance / travel

    def uncertain(self, start: Array, end: Array, steps: int, clearance: float) -> Mask:
        """Which samples of a straight line need a test; the others are certainly valid.

        What is farther from everything than it can travel to the next samples is clear there too: F. Schwarzer, M.
        Saha and J.-C. Latombe, "Adaptive dynamic collision checking for single and multiple articulated robots in
        complex environments", IEEE Transactions on Robotics 21(3), 2005. Here the distances are those of the spheres.

        Args:
            start: Where the line begins, (dof,).
            end: Where it ends, (dof,).
            steps: The number of even steps between its samples, which are numbered from 0 to `steps`.
            clearance: In metres, as for `valid`.

        Returns:
            (steps + 1,)
        """
        numbers = np.arange(steps + 1)
        Q = (start * (steps - numbers[:, None]) + end * numbers[:, None]) / steps
        inside = ((self._low <= Q) & (self._high >= Q)).all(axis=1)
        if not inside.all():
            return np.ones(steps + 1, dtype=bool)
        coarse = self._broadphase(clearance)
        looks = np.append(numbers[:-1:STRIDE], steps)
        self.checks += len(looks)
        travel = np.abs(end - start) * self._checker.travel(self.scene.opening, self.scene.held) / steps
        room = coarse.certain_steps(Q[looks], travel)
        looks, spread = looks[room > 0], np.floor(np.minimum(room[room > 0], steps)).astype(np.intp)
        covers = np.zeros(steps + 2, dtype=np.intp)  # how many more looks cover a sample than the one before it
        np.add.at(covers, np.maximum(looks - spread, 0), 1)
        np.add.at(covers, np.minimum(looks + spread, steps) + 1, -1)
        uncertain: Mask = (covers.cumsum()[:-1] == 0) | ~coarse.neighbours_clear(Q)
        return uncertain

    def _is_free(self, q: Sequence[float], clearance: float) -> bool:
        """The verdict on one configuration, without numpy where PyBullet's collision step clears it."""
        if not all(low <= value <= high for low, value, high in zip(self._lowest, q, self._highest, strict=True)):
            return False
        thick = self._checker.thick_world
        thick.show(self.scene)
        return thick.is_clear(q) or bool(self._free(np.array([q]), clearance, coarse=True)[0])

    def _free(self, Q: Array, clearance: float, coarse: bool) -> Mask:
        free = np.ones(len(Q), dtype=bool)
        if coarse:
            left = self._broadphase(clearance).left_open(Q)
        else:
            left = [(row, self._everything()) for row in range(len(Q))]
        if left:
            narrowphase = self._checker.narrowphase
            narrowphase.show(self.scene)
            for row, questions in left:
                free[row] = next(narrowphase.contacts(Q[row], questions, clearance), None) is None
        return free

    def _broadphase(self, clearance: float) -> Broadphase:
        if clearance not in self._coarse:
            self._coarse[clearance] = Broadphase(self._checker.cover, self.scene, clearance)
        return self._coarse[clearance]

    def _everything(self) -> Questions:
        checker, held = self._checker, [len(self._model.links)] if self.scene.held else []
        return Questions(
            boxes=[
                (number, body)
                for number, box in enumerate(self.scene.boxes)
                for body in (*checker.links, *held)
                if not (box.fixed and body in checker.mounted_links)
            ],
            pairs=[*checker.pairs, *((link, body) for body in held for link in checker.arm_links)],
        )
