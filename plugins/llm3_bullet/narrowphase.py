"""Exact answers, by PyBullet: what touches what in one configuration.

Nothing here remembers what was asked before. Closest-point queries build their contacts anew each time, where
PyBullet's own collision step keeps them from one step to the next, and with them a history.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass, field
from typing import Any

import numpy as np
from numpy.typing import NDArray

from llm3.errors import InputError
from llm3.types import ITSELF, Contact
from llm3_bullet.box_pool import BoxPool, Role
from llm3_bullet.clients import BulletClient, quiet
from llm3_bullet.model import RobotModel
from llm3_bullet.mounting import urdf_file
from llm3_bullet.robot import RobotDescription
from llm3_bullet.robot_body import RobotBody
from llm3_bullet.scene import Scene, Size

Array = NDArray[np.float64]


@dataclass
class Questions:
    """What is left to ask PyBullet about one configuration.

    A body that moves is the number of a link or, one more than the last, that of the held box.
    """

    boxes: list[tuple[int, int]] = field(default_factory=list)
    """Boxes, by their number in the scene, and the bodies that may touch them."""
    pairs: list[tuple[int, int]] = field(default_factory=list)
    """Pairs of bodies, the one with the smaller number first, that may touch each other."""


class Narrowphase:
    """The robot and a scene's boxes in a PyBullet world."""

    def __init__(self, client: BulletClient, model: RobotModel) -> None:
        """Load the robot; boxes are loaded when a scene first needs them.

        Raises:
            InputError: PyBullet cannot load the robot.
        """
        self._client = client
        self.robot = _load(client, model.description)
        self._body = RobotBody(client, self.robot, model)
        gripper = {model.link(name) for name in model.description.gripper.links}
        self._parts = ["gripper" if link in gripper else "arm" for link in range(len(model.links))]
        self._links = model.links
        self.boxes = BoxPool(client, self._box)
        self._scene = Scene()
        for link in range(len(model.links)):  # queries do not ask for it, and PyBullet's own step has less to do
            client.setCollisionFilterGroupMask(self.robot, link - 1, 0, 0)

    def show(self, scene: Scene) -> None:
        """Put the scene's boxes where they are."""
        if scene is not self._scene:
            self.boxes.show(scene)
            self._body.open(scene.opening)
            self._scene = scene

    def contacts(self, q: Array, questions: Questions, clearance: float) -> Iterator[Contact]:
        """Everything closer than the clearance, one question after the other, each asked when it is its turn.

        Args:
            q: A configuration, (dof,).
            questions: What to ask.
            clearance: In metres; negative to let things penetrate so far.
        """
        scene, closest, horizon = self._scene, self._client.getClosestPoints, max(clearance, 0.0)
        self._body.pose(q.tolist())
        if scene.held and any(body == len(self._links) for _, body in (*questions.boxes, *questions.pairs)):
            self._body.hold(self.boxes.held, scene.held.grasp)
        for box, body in questions.boxes:
            number, link = self._numbers(body)
            for row in closest(number, self.boxes.bodies[box], horizon, link):
                if row[8] < clearance:
                    yield self._contact(row, body, scene.boxes[box].name)
        for a, b in questions.pairs:
            number, link = self._numbers(b)
            for row in closest(number, self.robot, horizon, link, a - 1):
                if row[8] < clearance:
                    yield self._contact(row, b, ITSELF, self._links[a])

    def _numbers(self, body: int) -> tuple[int, int]:
        """PyBullet's numbers of the body and of its link."""
        return (self.robot, body - 1) if body < len(self._links) else (self.boxes.held, -1)

    def _contact(self, row: Sequence[Any], body: int, thing: str, other_link: str = "") -> Contact:
        """A contact from PyBullet's closest points."""
        if body < len(self._links):
            part, link = self._parts[body], self._links[body]
        else:
            assert self._scene.held  # noqa: S101  # nobody asks about a held box where there is none
            part, link = f"held {self._scene.held.name}", ""
        return Contact(part, thing, -row[8], row[7], row[6], link=link, other_link=other_link)

    def link_distance(self, q: Array, pair: tuple[int, int], horizon: float = 0.3) -> float:
        """Distance in metres between two links in a configuration (dof,); at least the horizon if it is beyond.

        The fingers are where they were last.
        """
        a, b = pair
        self._body.pose(q.tolist())
        rows = self._client.getClosestPoints(self.robot, self.robot, horizon, b - 1, a - 1)
        return min((float(row[8]) for row in rows), default=horizon)

    def _box(self, size: Size, _: Role) -> int:
        shape = self._client.createCollisionShape(self._client.GEOM_BOX, halfExtents=[side / 2 for side in size])
        body = int(self._client.createMultiBody(0.0, shape))
        self._client.setCollisionFilterGroupMask(body, -1, 0, 0)
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
