"""A domain of worlds around a tabletop: any robot, a stage, motors, each world made out of the last one."""

from __future__ import annotations

from abc import abstractmethod
from contextlib import ExitStack, closing
from typing import TYPE_CHECKING, Any

from llm3.interfaces import Domain, Env, Executor, Option, Options, Scenery, Stage
from llm3.types import Noise

if TYPE_CHECKING:  # a domain is cheap to make, and what a world needs is not cheap to import
    from llm3_bullet.robot import RobotDescription
    from llm3_bullet.tabletop.env import TabletopEnv
    from llm3_bullet.tabletop.looks import Seen
    from llm3_bullet.workcell import Workcell

ROBOT = Option("robot", "panda", "panda, iiwa, or a .json file that describes another one")


class TabletopDomain(Domain):
    """What is left to a subclass: its instances, its Env, and the capabilities that it has."""

    options: tuple[Option, ...] = (ROBOT,)

    @abstractmethod
    def env(self, instance: Any, workcell: Workcell, options: Options) -> TabletopEnv:
        """The world of an instance.

        Args:
            instance: An `instance_type`.
            workcell: The robot and its simulators; the Env owns them from now on.
            options: A value for every one of the domain's `options`.
        """

    def self_contained(self, options: Options) -> Options:
        """With the description of a robot that comes from a file."""
        from llm3_bullet.robots import in_place

        return {**options, "robot": in_place(options["robot"])}

    def make(self, instance: Any, options: Options) -> TabletopEnv:
        """A PyBullet world without a window."""
        from llm3_bullet.robots import find_robot
        from llm3_bullet.workcell import Workcell

        with ExitStack() as stack:
            cell = stack.enter_context(closing(Workcell(find_robot(options["robot"]))))
            env = self.env(instance, cell, options)
            stack.pop_all()  # it is the Env's to close now
            return env

    def stage(self, instance: Any, options: Options, window: bool = False) -> Stage | None:
        """The robot, the furniture and the boxes in a PyBullet world of their own."""
        from llm3_bullet.clients import connect
        from llm3_bullet.model import RobotModel
        from llm3_bullet.robots import find_robot
        from llm3_bullet.stage import BulletStage

        with ExitStack() as stack:
            client = stack.enter_context(connect(gui=window))
            robot = find_robot(options["robot"])
            seen = self._seen(robot, instance, options)
            stage = BulletStage(client, RobotModel(robot), seen.boxes, seen.colors, seen.camera)
            stack.pop_all()  # it is the stage's to close now
            return stage

    def scenery(self, instance: Any, options: Options) -> Scenery | None:
        """The robot's links, the furniture and the boxes."""
        from llm3_bullet.model import RobotModel
        from llm3_bullet.robots import find_robot
        from llm3_bullet.scenery import BulletScenery

        robot = find_robot(options["robot"])
        seen = self._seen(robot, instance, options)
        return BulletScenery(RobotModel(robot), seen.boxes, seen.colors, seen.camera)

    def executor(self, instance: Any, options: Options, noise: Noise) -> Executor | None:
        """A PyBullet world with motors, friction and gravity."""
        from llm3_bullet.tabletop.executor import TabletopExecutor

        return TabletopExecutor(self.make(instance, options), noise)

    def _seen(self, robot: RobotDescription, instance: Any, options: Options) -> Seen:
        from llm3_bullet.tabletop.looks import seen
        from llm3_bullet.workcell import Workcell

        with closing(Workcell(robot)) as cell:
            return seen(self.env(instance, cell, options))

    def remake(self, env: Env, instance: Any, options: Options) -> Env | None:
        """A world around the same robot, whose simulators go on; None for another robot."""
        from llm3_bullet.robots import find_robot
        from llm3_bullet.tabletop.env import TabletopEnv

        if not isinstance(env, TabletopEnv):
            return None
        cell = env.tabletop.workcell
        return self.env(instance, cell, options) if cell.fits(find_robot(options["robot"])) else None
