"""A robot's body in a PyBullet world, which is put into one configuration after another."""

from __future__ import annotations

from collections.abc import Sequence
from functools import partial

import numpy as np
from numpy.typing import NDArray

from llm3.types import Pose
from llm3_bullet.clients import BulletClient
from llm3_bullet.model import RobotModel

Array = NDArray[np.float64]


class RobotBody:
    """Poses the links by PyBullet's own kinematics."""

    def __init__(self, client: BulletClient, number: int, model: RobotModel) -> None:
        """Take the body.

        Args:
            client: The world.
            number: PyBullet's number of the body.
            model: The robot, whose joints and links the body has in the same order.
        """
        self._client, self.number = client, number
        self._fingers, self._tool = model.finger_joints, model.tool - 1
        self._reset = partial(client.resetJointStatesMultiDof, number, list(model.arm_joints))

    def open(self, opening: float) -> None:
        """Put the fingers so far apart, in metres."""
        for finger in self._fingers:
            self._client.resetJointState(self.number, finger, opening / 2)

    def pose(self, q: Sequence[float]) -> None:
        """Put the arm into a configuration (dof,)."""
        self._reset([[value] for value in q])

    def hold(self, body: int, grasp: Pose) -> None:
        """Put a body where the robot holds it, by a pose in the tool frame."""
        client = self._client
        tool = client.getLinkState(self.number, self._tool, computeForwardKinematics=True)
        pose = client.multiplyTransforms(tool[4], tool[5], grasp.position, grasp.orientation)
        client.resetBasePositionAndOrientation(body, *pose)
