"""A cup that holds by suction."""

from __future__ import annotations

from math import pi

import numpy as np

from llm3_bullet.execution.hand import Hand
from llm3_bullet.execution.world import MotorWorld
from llm3_bullet.robot import SuctionGripper
from llm3_bullet.scene import Size


class Cup(Hand):
    """Holds what is at its rim when the pump starts, until it is let go or pulls too much."""

    def __init__(self, world: MotorWorld, gripper: SuctionGripper) -> None:
        """Take the cup; the pump is off."""
        super().__init__(world)
        self._radius = gripper.cup_radius
        self._strength = world.settings.suction * pi * gripper.cup_radius**2
        self._link = world.model.tool - 1
        self._held: str | None = None
        self._bond = -1
        self._missed = ""

    def take(self, name: str, size: Size) -> None:
        """Start the pump: it holds the box if the whole rim is at one of its faces."""
        self.let_go()
        self._missed = self._gap(name, size)
        if self._missed:
            return
        client, robot, body = self.world.client, self.world.robot, self.world.bodies[name]
        link = client.getLinkState(robot, self._link, computeForwardKinematics=True)
        grasp = client.multiplyTransforms(
            *client.invertTransform(link[0], link[1]), *client.getBasePositionAndOrientation(body)
        )
        self._bond = int(
            client.createConstraint(
                robot, self._link, body, -1, client.JOINT_FIXED, (0, 0, 0), grasp[0], (0, 0, 0), grasp[1]
            )
        )
        client.changeConstraint(self._bond, maxForce=2 * self._strength)  # `look_after` ends it before
        self._held = name

    def let_go(self) -> None:
        """Stop the pump."""
        if self._held is not None:
            self.world.client.removeConstraint(self._bond)
        self._held = None

    def held(self) -> str | None:
        """The box at the rim."""
        return self._held

    def missed(self, name: str) -> str:  # noqa: ARG002  # of the last that was to be taken
        """Where the cup was instead."""
        return self._missed

    def look_after(self) -> None:
        """Let a box break away that pulls too much."""
        if self._held is not None:
            pull = np.linalg.norm(self.world.client.getConstraintState(self._bond)[:3])
            if pull > self._strength:
                self.let_go()

    def _gap(self, name: str, size: Size) -> str:
        """Why the rim is not at a face of a box; empty if it is."""
        settings, half = self.world.settings, np.array(size) / 2
        cup = np.linalg.inv(self.world.box(name)) @ self.world.tool()
        across = int(np.argmax(np.abs(cup[:3, 2])))
        distance = float(abs(abs(cup[across, 3]) - half[across]))
        if distance > settings.cup_reach:
            return f"the cup was {distance * 1000:.1f} mm from its face"
        tilt = float(np.arccos(min(1.0, abs(cup[across, 2]))))
        if tilt > settings.cup_tilt:
            return f"the cup leaned by {np.degrees(tilt):.1f} degrees against its face"
        beyond = float(np.delete(np.abs(cup[:3, 3]) + self._radius - half, across).max())
        return f"the cup reached {beyond * 1000:.1f} mm beyond its face" if beyond > 0 else ""
