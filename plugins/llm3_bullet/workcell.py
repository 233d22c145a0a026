"""A robot with everything that plans for it, over three simulators of its own."""

from __future__ import annotations

from llm3_bullet.clients import connect
from llm3_bullet.collision import CollisionChecker
from llm3_bullet.inverse import InverseKinematics
from llm3_bullet.kinematics import Kinematics
from llm3_bullet.model import RobotModel
from llm3_bullet.robot import Gripper, RobotDescription
from llm3_bullet.settle import Settler
from llm3_bullet.touchdown import TouchdownSettings
from llm3_bullet.touchdown_planner import TouchdownPlanner

MOST_BODIES = 300
"""A world with more of them than this is given up: they make PyBullet slow, and take memory."""


class Workcell:
    """What a domain needs to plan with one robot. Whatever it keeps is a cache: answers depend on questions alone."""

    def __init__(self, description: RobotDescription) -> None:
        """Start the simulators and load the robot.

        Args:
            description: The robot.

        Raises:
            MissingDependency: PyBullet is not installed.
        """
        self.model = RobotModel(description)
        self.kinematics = Kinematics(self.model)
        self._clients = (connect(), connect(), connect())  # the robot among boxes, the same thicker, boxes that fall
        self.checker = CollisionChecker(self._clients[0], self.model, self.kinematics, self._clients[1])
        self.settler = Settler(self._clients[2])
        self.inverse = InverseKinematics(self.kinematics)
        self.touchdowns = TouchdownPlanner(self.kinematics, self.inverse, self.checker, TouchdownSettings())

    @property
    def gripper(self) -> Gripper:
        """The robot's gripper."""
        return self.model.description.gripper

    def fits(self, description: RobotDescription) -> bool:
        """Whether it serves for another problem as well as a new one.

        It has to be open, to have just this robot, and not to be full of bodies for boxes of other sizes.
        """
        pools = self.checker.narrowphase.boxes, self.checker.thick_world.boxes
        roomy = all(client.is_open for client in self._clients) and all(pool.made <= MOST_BODIES for pool in pools)
        return roomy and self.model.description == description

    def close(self) -> None:
        """Stop the simulators. Calling it twice does no harm."""
        for client in self._clients:
            client.close()
