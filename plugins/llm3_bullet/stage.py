"""A world to look at: the robot and coloured boxes, in a window or in a picture."""

from __future__ import annotations

from collections.abc import Iterable, Mapping

import numpy as np
from numpy.typing import NDArray

from llm3.interfaces import Picture, Stage
from llm3.types import GREY, Camera, Color, Moment
from llm3_bullet.clients import BulletClient, quiet
from llm3_bullet.kinematics import Kinematics
from llm3_bullet.model import RobotModel
from llm3_bullet.mounting import urdf_file
from llm3_bullet.poses import as_matrix, as_pose
from llm3_bullet.scene import Box


class BulletStage(Stage):
    """A robot among boxes, drawn by PyBullet."""

    def __init__(
        self,
        client: BulletClient,
        model: RobotModel,
        boxes: Iterable[Box],
        colors: Mapping[str, Color],
        camera: Camera,
    ) -> None:
        """Set the stage.

        Args:
            client: A world of its own, with or without a window; it is the stage's to close from now on.
            model: The robot.
            boxes: What stands where; those that moments tell of move.
            colors: Colours of boxes by name; others are grey.
            camera: Where one looks from.
        """
        self._client, self._camera = client, camera
        self._model, self._kinematics = model, Kinematics(model)
        with urdf_file(model.description) as file, quiet():
            self._robot = int(client.loadURDF(str(file), useFixedBase=True))
        self._bodies = {box.name: self._make(box, colors.get(box.name, GREY)) for box in boxes}
        client.configureDebugVisualizer(client.COV_ENABLE_GUI, 0)
        client.resetDebugVisualizerCamera(camera.distance, camera.yaw, camera.pitch, camera.target)

    def show(self, moment: Moment) -> None:
        """Move everything there; the fingers are open until a motion has told how far they are."""
        q = np.array(moment.configuration)
        poses = dict(moment.poses)
        if moment.held:
            tool = self._kinematics.tool(q[None])[0]
            poses[moment.held.object] = as_pose(tool @ as_matrix(moment.held.grasp))
        for name, pose in poses.items():
            self._client.resetBasePositionAndOrientation(self._bodies[name], pose.position, pose.orientation)
        self._pose_robot(q, self._model.description.gripper.max_opening if moment.opening is None else moment.opening)

    def picture(self, width: int, height: int) -> Picture:
        """What the camera sees, by PyBullet's software renderer, which needs no screen."""
        client, camera = self._client, self._camera
        view = client.computeViewMatrixFromYawPitchRoll(
            camera.target, camera.distance, camera.yaw, camera.pitch, 0.0, 2
        )
        projection = client.computeProjectionMatrixFOV(45.0, width / height, 0.05, 10.0)
        image = client.getCameraImage(
            width,
            height,
            view,
            projection,
            lightDirection=(0.4, -0.6, 1.4),
            shadow=1,
            renderer=client.ER_TINY_RENDERER,
        )
        return np.asarray(image[2], dtype=np.uint8).reshape(height, width, 4)[:, :, :3]

    def close(self) -> None:
        """Close the window, if there is one."""
        self._client.close()

    def _make(self, box: Box, color: Color) -> int:
        half = [side / 2 for side in box.size]
        shape = self._client.createVisualShape(self._client.GEOM_BOX, halfExtents=half, rgbaColor=[*color, 1.0])
        return int(self._client.createMultiBody(0.0, -1, shape, box.pose.position, box.pose.orientation))

    def _pose_robot(self, q: NDArray[np.float64], opening: float) -> None:
        for joint, value in zip(self._model.arm_joints, q.tolist(), strict=True):
            self._client.resetJointState(self._robot, joint, value)
        for joint in self._model.finger_joints:
            self._client.resetJointState(self._robot, joint, opening / 2)
