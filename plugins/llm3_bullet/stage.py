"""A world to look at: the robot and coloured boxes, in a window or in a picture.

Nothing is planned or checked here, so that drawing can neither slow planning down nor change it.
"""

from __future__ import annotations

from collections.abc import Callable, Iterable, Mapping
from dataclasses import dataclass
from itertools import pairwise
from time import sleep

import numpy as np
from numpy.typing import NDArray

from llm3.types import EventKind, Held, Motion
from llm3_bullet.clients import BulletClient, quiet
from llm3_bullet.kinematics import Kinematics
from llm3_bullet.model import RobotModel
from llm3_bullet.mounting import urdf_file
from llm3_bullet.poses import as_matrix, as_pose
from llm3_bullet.scene import Box

Color = tuple[float, float, float]
"""Red, green and blue, each 0 to 1."""


@dataclass(frozen=True)
class Camera:
    """Where one looks from."""

    target: tuple[float, float, float] = (0.5, 0.0, 0.1)
    """What is in the middle, in metres."""
    distance: float = 1.5
    yaw: float = 55.0
    """Degrees about the vertical."""
    pitch: float = -35.0
    """Degrees; negative looks down."""


class Stage:
    """Shows states and plays motions."""

    def __init__(
        self,
        client: BulletClient,
        model: RobotModel,
        colors: Mapping[str, Color],
        camera: Camera = Camera(),
        pause: Callable[[float], None] = sleep,
    ) -> None:
        """Set the stage.

        Args:
            client: A world of its own, with or without a window.
            model: The robot.
            colors: Colours of boxes by name; others are grey.
            camera: Where one looks from.
            pause: Waits for some seconds, between two frames.
        """
        self._client, self._colors, self._camera, self._pause = client, colors, camera, pause
        self._model, self._kinematics = model, Kinematics(model)
        with urdf_file(model.description) as file, quiet():
            self._robot = int(client.loadURDF(str(file), useFixedBase=True))
        self._bodies: dict[str, int] = {}
        self._held: Held | None = None
        self._opening = model.description.gripper.max_opening
        client.configureDebugVisualizer(client.COV_ENABLE_GUI, 0)
        client.resetDebugVisualizerCamera(camera.distance, camera.yaw, camera.pitch, camera.target)

    def show(self, boxes: Iterable[Box], configuration: Iterable[float], held: Held | None, opening: float) -> None:
        """Show a state; boxes that are not mentioned, but were shown before, stay where they are.

        Args:
            boxes: Those that are not held.
            configuration: The arm's joint values, (dof,).
            held: What is in the gripper; it was among the boxes of an earlier call.
            opening: Distance between the fingers in metres.
        """
        for box in boxes:
            if box.name not in self._bodies:
                self._bodies[box.name] = self._make(box)
            self._client.resetBasePositionAndOrientation(
                self._bodies[box.name], box.pose.position, box.pose.orientation
            )
        self._held, self._opening = held, opening
        self._pose_robot(np.array(tuple(configuration)))

    def play(self, motion: Motion, step: float = 0.03, frame: float = 1 / 60) -> None:
        """Move along a motion, from the state that is shown.

        Args:
            motion: Its segments and events.
            step: Largest change of a joint between two frames, in radians.
            frame: Seconds a frame.
        """
        for segment in motion.segments:
            for event in segment.events:
                if event.kind is EventKind.GRIPPER and event.opening is not None:
                    self._opening = event.opening
                elif event.kind is EventKind.ATTACH and event.object and event.grasp:
                    self._held = Held(event.object, event.grasp)
                elif event.kind is EventKind.DETACH:
                    self._held = None
            waypoints = np.array(segment.waypoints)
            for a, b in pairwise(waypoints):
                count = max(1, int(np.ceil(np.abs(b - a).max() / step)))
                for t in np.linspace(0.0, 1.0, count + 1)[1:]:
                    self._pose_robot(a + t * (b - a))
                    self._pause(frame)

    def picture(self, width: int = 640, height: int = 480) -> NDArray[np.uint8]:
        """What the camera sees, by PyBullet's software renderer: (height, width, 3), red, green, blue."""
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

    def close(self, last_look: float = 0.0) -> None:
        """Close the window after so many seconds. Calling it twice does no harm."""
        if self._client.is_open:
            self._pause(last_look)
        self._client.close()

    def _make(self, box: Box) -> int:
        half = [side / 2 for side in box.size]
        color = [*self._colors.get(box.name, (0.6, 0.6, 0.6)), 1.0]
        shape = self._client.createVisualShape(self._client.GEOM_BOX, halfExtents=half, rgbaColor=color)
        return int(self._client.createMultiBody(0.0, -1, shape))

    def _pose_robot(self, q: NDArray[np.float64]) -> None:
        for joint, value in zip(self._model.arm_joints, q.tolist(), strict=True):
            self._client.resetJointState(self._robot, joint, value)
        for joint in self._model.finger_joints:
            self._client.resetJointState(self._robot, joint, self._opening / 2)
        if self._held:
            pose = as_pose(self._kinematics.tool(q[None])[0] @ as_matrix(self._held.grasp))
            body = self._bodies[self._held.object]
            self._client.resetBasePositionAndOrientation(body, pose.position, pose.orientation)
