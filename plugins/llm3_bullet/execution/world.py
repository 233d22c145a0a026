"""A robot with motors among boxes with mass, in PyBullet."""

from __future__ import annotations

import math
from collections.abc import Iterable, Mapping, Sequence

import numpy as np

from llm3.types import Pose
from llm3_bullet.clients import BulletClient, quiet
from llm3_bullet.execution.settings import ExecutionSettings
from llm3_bullet.model import RobotModel
from llm3_bullet.mounting import urdf_file
from llm3_bullet.poses import Array
from llm3_bullet.scene import Box

Frame = tuple[tuple[float, float, float], tuple[float, float, float, float]]
_GRAVITY = -9.81
_ITERATIONS = 100


class MotorWorld:
    """Everything moves by forces. Only while the world is being set up is anything put somewhere.

    The world is built anew for each execution, so the same commands have the same effect, to the last bit.
    """

    def __init__(
        self,
        client: BulletClient,
        model: RobotModel,
        boxes: Iterable[Box],
        configuration: Array,
        settings: ExecutionSettings,
    ) -> None:
        """Build it.

        Args:
            client: An empty simulator, which nothing else may use.
            model: The robot.
            boxes: Fixed and movable ones, where they begin.
            configuration: Of the arm at the start, (dof,); its gripper is wide open.
            settings: The physics.
        """
        self.client, self.model, self.settings = client, model, settings
        self.time_step = settings.boxes.time_step
        self.ticks = 0
        """Time steps since the start."""
        client.setPhysicsEngineParameter(
            fixedTimeStep=self.time_step,
            numSolverIterations=_ITERATIONS,
            solverResidualThreshold=0.0,  # a solver that stops sooner lets resting boxes creep
            deterministicOverlappingPairs=1,
        )
        client.setGravity(0.0, 0.0, _GRAVITY)
        with urdf_file(model.description) as file, quiet():
            self.robot = int(client.loadURDF(str(file), useFixedBase=True))
        boxes = sorted(boxes, key=lambda box: box.name)
        self.bodies: Mapping[str, int] = {box.name: self._make(box) for box in boxes}
        """PyBullet's numbers of all boxes, by name."""
        self.movable: tuple[str, ...] = tuple(box.name for box in boxes if not box.fixed)
        """The names of those that have a mass."""
        self._let_stand([self.bodies[box.name] for box in boxes if box.fixed])
        self._efforts = [
            client.getJointInfo(self.robot, joint)[10] or settings.default_effort for joint in model.arm_joints
        ]
        self._target = np.array(configuration, dtype=float)
        for joint, value in zip(model.arm_joints, self._target.tolist(), strict=True):
            client.resetJointState(self.robot, joint, value)
        for joint in model.finger_joints:
            client.resetJointState(self.robot, joint, model.description.gripper.max_opening / 2)

    # ---- what is commanded ----------------------------------------------------------------------------

    def put(self, name: str, position: Sequence[float], orientation: Sequence[float]) -> None:
        """Put a box somewhere, before the first time step."""
        self.client.resetBasePositionAndOrientation(self.bodies[name], position, orientation)

    def drive(self, target: Array) -> None:
        """One time step, at the end of which the arm is meant to be at `target`, (dof,)."""
        gains = [self.settings.position_gain] * len(target)
        self.client.setJointMotorControlArray(
            self.robot,
            self.model.arm_joints,
            self.client.POSITION_CONTROL,
            targetPositions=self._target.tolist(),  # what it should have come to by now, from where it goes on
            targetVelocities=((target - self._target) / self.time_step).tolist(),
            forces=self._efforts,
            positionGains=gains,
            velocityGains=[1.0] * len(target),
        )
        self._target = target
        self.client.stepSimulation()
        self.ticks += 1

    def stay(self) -> None:
        """One time step in which the arm is meant to stand still."""
        self.drive(self._target)

    # ---- what is seen ---------------------------------------------------------------------------------

    @property
    def configuration(self) -> Array:
        """Of the arm, (dof,)."""
        return np.array([state[0] for state in self.client.getJointStates(self.robot, self.model.arm_joints)])

    @property
    def opening(self) -> float:
        """The distance between the fingers, in metres; 0 without any."""
        return float(sum(self.client.getJointState(self.robot, joint)[0] for joint in self.model.finger_joints))

    def tool(self) -> Array:
        """The tool frame in the world, (4, 4)."""
        state = self.client.getLinkState(self.robot, self.model.tool - 1, computeForwardKinematics=True)
        return self._matrix(state[4], state[5])

    def box(self, name: str) -> Array:
        """A box's frame in the world, (4, 4)."""
        return self._matrix(*self.frame(name))

    def frame(self, name: str) -> Frame:
        """The same as a position and a quaternion x, y, z, w."""
        frame: Frame = self.client.getBasePositionAndOrientation(self.bodies[name])
        return frame

    def depth(self, name: str) -> float:
        """How deep a box is in another one, or in the robot, in metres; 0 if it is in none."""
        body = self.bodies[name]
        others = (other for other in (self.robot, *self.bodies.values()) if other != body)
        points = (point for other in others for point in self.client.getClosestPoints(body, other, 0.0))
        return max((-float(point[8]) for point in points), default=0.0)

    def poses(self) -> dict[str, Pose]:
        """Of all movable boxes, by name, rounded to the grid of states."""
        return {name: Pose(*self.frame(name)) for name in self.movable}

    def rests(self) -> bool:
        """Whether all joints and all boxes are slow."""
        joints = (*self.model.arm_joints, *self.model.finger_joints)
        speeds = (abs(state[1]) for state in self.client.getJointStates(self.robot, joints))
        return all(speed < self.settings.still for speed in speeds) and all(map(self._is_slow, self.movable))

    # ---- how it is made -------------------------------------------------------------------------------

    def _make(self, box: Box) -> int:
        client, physics = self.client, self.settings.boxes
        shape = client.createCollisionShape(client.GEOM_BOX, halfExtents=[side / 2 for side in box.size])
        mass = 0.0 if box.fixed else physics.density * float(np.prod(box.size))
        body = int(client.createMultiBody(mass, shape, -1, box.pose.position, box.pose.orientation))
        client.changeDynamics(body, -1, lateralFriction=physics.friction, restitution=0.0)
        return body

    def _let_stand(self, fixed: Iterable[int]) -> None:
        """Let the robot touch what it stands on."""
        for name in self.model.description.mounted_links:
            for body in fixed:
                self.client.setCollisionFilterPair(self.robot, body, self.model.link(name) - 1, -1, 0)

    def _is_slow(self, name: str) -> bool:
        linear, angular = self.client.getBaseVelocity(self.bodies[name])
        limits = self.settings.boxes
        return math.hypot(*linear) < limits.linear_speed and math.hypot(*angular) < limits.angular_speed

    def _matrix(self, position: Iterable[float], orientation: Iterable[float]) -> Array:
        frame = np.eye(4)
        frame[:3, :3] = np.reshape(self.client.getMatrixFromQuaternion(orientation), (3, 3))
        frame[:3, 3] = tuple(position)
        return frame
