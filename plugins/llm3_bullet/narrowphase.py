"""Exact answers, by PyBullet: what touches what in one configuration.

Nothing here remembers what was asked before. Closest-point queries build their contacts anew each time, where
PyBullet's own collision step keeps them from one step to the next, and with them a history.
"""

from __future__ import annotations

from collections import defaultdict
from collections.abc import Iterator, Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from llm3.errors import InputError
from llm3.types import ITSELF, Contact
from llm3_bullet.clients import BulletClient, quiet
from llm3_bullet.model import RobotModel
from llm3_bullet.mounting import urdf_file
from llm3_bullet.robot import RobotDescription
from llm3_bullet.scene import Scene, Size

Array = NDArray[np.float64]


@dataclass(frozen=True)
class Questions:
    """What is left to ask PyBullet about one configuration."""

    boxes: Sequence[int]
    """Numbers of boxes that the robot may touch."""
    held_boxes: Sequence[int] = ()
    """Numbers of boxes that the held box may touch."""
    pairs: Sequence[tuple[int, int]] = ()
    """Pairs of links, the one nearer to the base first, that may touch each other."""
    held_links: Sequence[int] = ()
    """Links that the held box may touch."""


class Narrowphase:
    """The robot and a scene's boxes in a PyBullet world."""

    def __init__(self, client: BulletClient, model: RobotModel) -> None:
        """Load the robot; boxes are loaded when a scene first needs them.

        Raises:
            InputError: PyBullet cannot load the robot.
        """
        self._client = client
        self.robot = _load(client, model.description)
        self._joints = [*model.arm_joints, *model.finger_joints]
        gripper = {model.link(name) for name in model.description.gripper.links}
        self._parts = ["gripper" if link in gripper else "arm" for link in range(len(model.links))]
        self._mounted = {model.link(name) for name in model.description.mounted_links}
        self._pool: dict[Size, list[int]] = defaultdict(list)
        self._scene = Scene()
        self._bodies: list[int] = []
        self._held = -1

    def show(self, scene: Scene) -> None:
        """Put the scene's boxes where they are, unless they are there already."""
        if scene is self._scene or scene == self._scene:
            self._scene = scene
            return
        unused = {size: list(bodies) for size, bodies in self._pool.items()}
        self._bodies = [self._take(box.size, unused) for box in scene.boxes]
        for box, body in zip(scene.boxes, self._bodies, strict=True):
            self._client.resetBasePositionAndOrientation(body, box.pose.position, box.pose.orientation)
        self._held = self._take(scene.held.size, unused) if scene.held else -1
        for bodies in unused.values():
            for body in bodies:  # out of sight; nobody asks about them
                self._client.resetBasePositionAndOrientation(body, (0.0, 0.0, -100.0), (0.0, 0.0, 0.0, 1.0))
        self._scene = scene

    def contacts(
        self,
        q: Array,
        held: tuple[Array, Array] | None,
        questions: Questions,
        clearance: float,
    ) -> Iterator[Contact]:
        """Everything closer than the clearance, one question after the other, each asked when it is its turn.

        Args:
            q: A configuration, (dof,).
            held: World position and orientation (x, y, z, w) of the held box; None without one.
            questions: What to ask.
            clearance: In metres; negative to let things penetrate so far.
        """
        scene = self._scene
        self._place(q, scene.opening)
        closest, horizon = self._client.getClosestPoints, max(clearance, 0.0)
        for number in questions.boxes:
            box = scene.boxes[number]
            for row in closest(self.robot, self._bodies[number], horizon):
                link = row[3] + 1
                if row[8] < clearance and not (box.fixed and link in self._mounted):
                    yield Contact(self._parts[link], box.name, -row[8], row[7], row[6])
        for a, b in questions.pairs:
            for row in closest(self.robot, self.robot, horizon, b - 1, a - 1):
                if row[8] < clearance:
                    yield Contact(self._parts[b], ITSELF, -row[8], row[7], row[6])
        if scene.held is None or held is None:
            return
        self._client.resetBasePositionAndOrientation(self._held, *held)
        part = f"held {scene.held.name}"
        for number in questions.held_boxes:
            for row in closest(self._held, self._bodies[number], horizon):
                if row[8] < clearance:
                    yield Contact(part, scene.boxes[number].name, -row[8], row[7], row[6])
        for link in questions.held_links:
            for row in closest(self._held, self.robot, horizon, -1, link - 1):
                if row[8] < clearance:
                    yield Contact(part, ITSELF, -row[8], row[7], row[6])

    def link_distance(self, q: Array, pair: tuple[int, int], horizon: float = 0.3) -> float:
        """Distance in metres between two links in a configuration (dof,); at least the horizon if it is beyond."""
        a, b = pair
        self._place(q, 0.0)
        rows = self._client.getClosestPoints(self.robot, self.robot, horizon, b - 1, a - 1)
        return min((float(row[8]) for row in rows), default=horizon)

    def _place(self, q: Array, opening: float) -> None:
        fingers = len(self._joints) - len(q)
        positions = [[value] for value in q.tolist()] + [[opening / 2]] * fingers
        self._client.resetJointStatesMultiDof(self.robot, self._joints, positions)

    def _take(self, size: Size, unused: dict[Size, list[int]]) -> int:
        """A body of this size that the scene does not use yet."""
        if unused.get(size):
            return unused[size].pop(0)
        shape = self._client.createCollisionShape(self._client.GEOM_BOX, halfExtents=[side / 2 for side in size])
        body = int(self._client.createMultiBody(0.0, shape))
        self._pool[size].append(body)
        return body


def _load(client: BulletClient, robot: RobotDescription) -> int:
    drawn = client.getConnectionInfo()["connectionMethod"] == client.GUI
    flags = 0 if drawn else client.URDF_IGNORE_VISUAL_SHAPES
    try:
        with urdf_file(robot) as file, quiet():
            return int(client.loadURDF(str(file), useFixedBase=True, flags=flags))
    except client.error:
        raise InputError(
            f"PyBullet cannot load the robot file {robot.urdf}: a shape in it, or a mesh file that it names, is "
            f"missing or broken."
        ) from None
