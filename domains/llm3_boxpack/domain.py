"""The box-packing domain, as the framework sees it."""

from __future__ import annotations

from typing import Any

from llm3.errors import UsageError
from llm3.interfaces import Domain, Env, Option, Options, Regions, StandIn
from llm3.types import Sketch
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

    def make(self, instance: Any, options: Options) -> Env:
        """A PyBullet world without a window."""
        from llm3_boxpack.env import BoxpackEnv
        from llm3_bullet.robots import find_robot
        from llm3_bullet.workcell import Workcell

        wall_height = _wall_height(options["walls"])
        return BoxpackEnv(instance, Workcell(find_robot(options["robot"])), wall_height)

    def make_in_window(self, instance: Any, options: Options) -> Env | None:
        """A PyBullet world, with a second one in a window that plays what happens."""
        from llm3_boxpack.window import WindowEnv
        from llm3_bullet.clients import connect
        from llm3_bullet.robots import find_robot
        from llm3_bullet.workcell import Workcell

        wall_height, robot = _wall_height(options["walls"]), find_robot(options["robot"])
        client = connect(gui=True)
        return WindowEnv(instance, Workcell(robot), wall_height, client)

    def skeleton(self, instance: Any) -> tuple[Sketch, ...]:
        """Pick and place each box in turn."""
        return skeleton(instance)

    def regions(self, instance: Any) -> Regions:
        """The inside of the basket."""
        (x, y), (dx, dy) = instance.basket.center, instance.basket.size
        return {
            (PLACE.name, "x"): (x - dx / 2, x + dx / 2),
            (PLACE.name, "y"): (y - dy / 2, y + dy / 2),
        }

    def stand_in(self) -> StandIn:
        """Rules of thumb for packing."""
        from llm3_boxpack.stand_in import reply

        return reply


def _wall_height(text: str) -> float:
    try:
        height = float(text)
    except ValueError:
        height = -1.0
    if not 0.0 <= height <= MAX_WALL_HEIGHT:
        raise UsageError(f"option 'walls' must be a height from 0 to {MAX_WALL_HEIGHT:g} m, not {text!r}.")
    return height
