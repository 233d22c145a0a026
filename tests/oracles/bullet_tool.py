"""Where PyBullet's own kinematics sees the tool."""

from __future__ import annotations

from collections.abc import Callable, Iterator
from contextlib import contextmanager

import numpy as np

from llm3_bullet.clients import connect, quiet
from llm3_bullet.model import RobotModel
from llm3_bullet.mounting import urdf_file


@contextmanager
def tool_poses(model: RobotModel) -> Iterator[Callable[[np.ndarray], np.ndarray]]:
    """A function from configurations (N, dof) to tool poses (N, 4, 4), in part computed in single precision."""
    with connect() as client:
        with urdf_file(model.description) as file, quiet():
            body = client.loadURDF(str(file), useFixedBase=True)

        def pose(q):
            for joint, position in zip(model.arm_joints, q, strict=True):
                client.resetJointState(body, joint, position)
            state = client.getLinkState(body, model.tool - 1, computeForwardKinematics=True)
            matrix = np.eye(4)
            matrix[:3, :3] = np.reshape(client.getMatrixFromQuaternion(state[5]), (3, 3))
            matrix[:3, 3] = state[4]
            return matrix

        yield lambda Q: np.array([pose(q) for q in Q]).reshape(-1, 4, 4)
