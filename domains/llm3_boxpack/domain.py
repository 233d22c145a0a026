"""The box-packing domain, as the framework sees it."""

from __future__ import annotations

from contextlib import ExitStack, closing
from typing import Any

from llm3.errors import UsageError
from llm3.interfaces import Domain, Env, Option, Options, PlanVerifier, Regions, StandIn
from llm3.types import Shape, Sketch, State
from llm3_boxpack.actions import PLACE, skeleton
from llm3_boxpack.instance import BoxpackInstance
from llm3_boxpack.settings import SETTINGS, generate

MAX_WALL_HEIGHT = 0.2


class BoxPack(Domain):
    """Pack four boxes into a basket, with the sizes of the paper's settings."""

    name = "boxpack"
    description = "An arm packs boxes into a basket on a table."
    settings = SETTINGS
    default_setting = "medium-small"
    options = (
        Option("robot", "panda", "panda, iiwa, or a .json file that describes another one"),
        Option("walls", "0", f"height of the basket's walls in metres, 0 to {MAX_WALL_HEIGHT:g}"),
    )
    instance_type = BoxpackInstance

    def instance(self, setting: str, seed: int) -> BoxpackInstance:
        """Start poses drawn from the seed."""
        return generate(setting, seed)

    def self_contained(self, options: Options) -> Options:
        """With the description of a robot that comes from a file."""
        from llm3_bullet.robots import in_place

        return {**options, "robot": in_place(options["robot"])}

    def make(self, instance: Any, options: Options) -> Env:
        """A PyBullet world without a window."""
        from llm3_boxpack.env import BoxpackEnv
        from llm3_bullet.robots import find_robot
        from llm3_bullet.workcell import Workcell

        wall_height, robot = _wall_height(options["walls"]), find_robot(options["robot"])
        with ExitStack() as stack:
            cell = stack.enter_context(closing(Workcell(robot)))
            env = BoxpackEnv(instance, cell, wall_height)
            stack.pop_all()  # it is the Env's to close now
            return env

    def make_in_window(self, instance: Any, options: Options) -> Env | None:
        """A PyBullet world, with a second one in a window that plays what happens."""
        from llm3_boxpack.window import WindowEnv
        from llm3_bullet.clients import connect
        from llm3_bullet.robots import find_robot
        from llm3_bullet.workcell import Workcell

        wall_height, robot = _wall_height(options["walls"]), find_robot(options["robot"])
        client = connect(gui=True)
        return WindowEnv(instance, Workcell(robot), wall_height, client)

    def remake(self, env: Env, instance: Any, options: Options) -> Env | None:
        """A world around the same robot, whose simulators go on; None for another robot, or out of a window."""
        from llm3_boxpack.env import BoxpackEnv
        from llm3_bullet.robots import find_robot

        if type(env) is not BoxpackEnv:
            return None
        return env.remade(instance, find_robot(options["robot"]), _wall_height(options["walls"]))

    def skeleton(self, instance: Any) -> tuple[Sketch, ...]:
        """Pick and place each box in turn."""
        return skeleton(instance)

    def regions(self, instance: Any) -> Regions:
        """For each box the centres at which it can lie in the basket at all, turned suitably."""
        basket = instance.basket
        return {
            (PLACE.name, (box.name,), axis): _inset(center, side, min(box.size[:2]))
            for box in instance.boxes
            for axis, center, side in zip("xy", basket.center, basket.size, strict=True)
        }

    def stand_in(self) -> StandIn:
        """Rules of thumb for packing."""
        from llm3_boxpack.stand_in import reply

        return reply

    def verifier(self, instance: Any, options: Options) -> PlanVerifier:
        """A plain PyBullet world, in which a plan is played again."""
        from llm3_boxpack.verification import BoxpackVerifier
        from llm3_bullet.robots import find_robot

        return BoxpackVerifier(instance, find_robot(options["robot"]), _wall_height(options["walls"]))

    def top_view(self, instance: Any, state: State) -> tuple[Shape, ...]:
        """The basket and the boxes."""
        from llm3_boxpack.top_view import top_view

        return top_view(instance, state)


def _inset(center: float, side: float, width: float) -> tuple[float, float]:
    """Where along a side the centre of something of this width can be; the middle if it is too wide."""
    room = max(0.0, side - width) / 2
    return center - room, center + room


def _wall_height(text: str) -> float:
    try:
        height = float(text)
    except ValueError:
        height = -1.0
    if not 0.0 <= height <= MAX_WALL_HEIGHT:
        raise UsageError(f"option 'walls' must be a height from 0 to {MAX_WALL_HEIGHT:g} m, not {text!r}.")
    return height
