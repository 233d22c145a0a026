"""Fingers that hold by friction."""

from __future__ import annotations

from llm3_bullet.execution.hand import Hand
from llm3_bullet.execution.world import MotorWorld
from llm3_bullet.robot import ParallelGripper
from llm3_bullet.scene import Size

STOPPED = 0.0003
"""Fingers that stand farther apart than they should, in metres, were stopped by something."""
BACK_OFF = 0.002
"""How much farther they open then, in metres: PyBullet lets what pushes be as deep as a millimetre in one another."""
_GEAR_FORCE = 500.0
"""More than anything in such a world pushes with, in N."""


class Fingers(Hand):
    """Two fingers that push with a bounded force. A gear keeps them symmetric, and friction is all that holds."""

    def __init__(self, world: MotorWorld, gripper: ParallelGripper) -> None:
        """Give the pads their friction, and the fingers their gear."""
        super().__init__(world)
        client, settings = world.client, world.settings
        self._widest = gripper.max_opening
        self._fingers = one, other = world.model.finger_joints  # a link has the number of the joint that carries it
        self._closed = False
        self._meant = self._widest
        gear = client.createConstraint(
            world.robot, one, world.robot, other, client.JOINT_GEAR, (1, 0, 0), (0, 0, 0), (0, 0, 0)
        )
        client.changeConstraint(gear, gearRatio=-1, erp=0.3, maxForce=_GEAR_FORCE)
        for link in self._fingers:
            client.changeDynamics(
                world.robot,
                link,
                lateralFriction=settings.pad_friction,
                spinningFriction=settings.pad_spin,
                frictionAnchor=1,
            )
        self.open_to(self._widest)

    def open_to(self, opening: float) -> None:
        """Move them there; what is in their way stops them."""
        settings, client = self.world.settings, self.world.client
        self._meant = opening
        for joint in self._fingers:
            client.setJointMotorControl2(
                self.world.robot,
                joint,
                client.POSITION_CONTROL,
                targetPosition=opening / 2,
                force=settings.grip_force,
                positionGain=settings.position_gain,
                velocityGain=1.0,
                maxVelocity=settings.finger_speed,
            )

    def relax(self) -> None:
        """Back off from what stopped them, unless they are to hold it: fingers do not grip before they are told."""
        if not self._closed and self.world.opening > self._meant + STOPPED:
            self.open_to(min(self._widest, self.world.opening + BACK_OFF))

    def take(self, name: str, size: Size) -> None:  # noqa: ARG002  # fingers close on whatever is there
        """Close until something stops them, and go on pushing."""
        self._closed = True
        self.open_to(0.0)

    def let_go(self) -> None:
        """Open a little."""
        self._closed = False
        self.open_to(min(self._widest, self.world.opening + self.world.settings.release))

    def held(self) -> str | None:
        """The box that both push against while they are closed."""
        return self._between() if self._closed else None

    def missed(self, name: str) -> str:  # noqa: ARG002  # whatever it was
        """What they closed on instead."""
        return f"the fingers closed on {self._between() or 'nothing'}"

    def _between(self) -> str | None:
        boxes = self.world.movable
        return next((name for name in boxes if all(self._pushes(name, link) for link in self._fingers)), None)

    def _pushes(self, name: str, link: int) -> bool:
        points = self.world.client.getContactPoints(self.world.robot, self.world.bodies[name], link, -1)
        return any(force > 0 for force in (point[9] for point in points))
