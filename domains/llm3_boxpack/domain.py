"""The box-packing domain, as the framework sees it."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

from llm3.errors import UsageError
from llm3.interfaces import Option, Options, PlanVerifier, Regions, StandIn
from llm3.types import Action, Shape, Sketch, State
from llm3_boxpack.actions import PLACE, pieces, skeleton
from llm3_boxpack.instance import MAX_WALL_HEIGHT, BoxpackInstance
from llm3_boxpack.settings import SETTINGS, generate, solution
from llm3_bullet.tabletop.domain import ROBOT, TabletopDomain

if TYPE_CHECKING:
    from llm3_bullet.tabletop.env import TabletopEnv
    from llm3_bullet.workcell import Workcell

OWN_WALLS = "own"
"""The walls that the problem has."""


class BoxPack(TabletopDomain):
    """Pack boxes into a basket: the paper's settings, and families of harder ones."""

    name = "boxpack"
    description = "An arm packs boxes into a basket on a table."
    settings = SETTINGS
    default_setting = "medium-small"
    options = (
        ROBOT,
        Option("walls", OWN_WALLS, f"height of the basket's walls in metres, 0 to {MAX_WALL_HEIGHT:g}, or {OWN_WALLS}"),
    )
    instance_type = BoxpackInstance

    def instance(self, setting: str, seed: int) -> BoxpackInstance:
        """Where the boxes start, and in the families all else, is drawn from the seed."""
        return generate(setting, seed)

    def witness(self, setting: str, seed: int) -> tuple[Action, ...] | None:
        """What a family's problem was made from, for the Panda; none for the paper's settings."""
        return solution(setting, seed)

    def env(self, instance: Any, workcell: Workcell, options: Options) -> TabletopEnv:
        """Boxes, a basket, what is in the way, and an arm."""
        from llm3_boxpack.env import BoxpackEnv

        return BoxpackEnv(instance, workcell, _wall_height(options["walls"]))

    def skeleton(self, instance: Any) -> tuple[Sketch, ...] | None:
        """Pick and place each box in turn."""
        return skeleton(instance)

    def pieces(self, instance: Any) -> tuple[tuple[Sketch, ...], ...]:
        """To pick and place each box, and each thing that is in the way."""
        return pieces(instance)

    def regions(self, instance: Any) -> Regions:
        """For each box the centres at which it can lie in the basket at all, turned suitably."""
        basket = instance.basket
        return {
            (PLACE.name, (box.name,), axis): _inset(center, side, min(box.size[:2]))
            for box in instance.boxes
            for axis, center, side in zip("xy", basket.center, basket.size, strict=True)
        }

    def self_contained(self, options: Options) -> Options:
        """With the description of a robot that comes from a file; walls that cannot be are refused before any work."""
        _wall_height(options["walls"])
        return super().self_contained(options)

    def stand_in(self) -> StandIn:
        """Rules of thumb for packing."""
        from llm3_boxpack.stand_in import reply

        return reply

    def verifier(self, instance: Any, options: Options) -> PlanVerifier:
        """A plain PyBullet world, in which a plan is played again."""
        from llm3_boxpack.verification import BoxpackVerifier
        from llm3_bullet.robots import find_robot

        return BoxpackVerifier(instance, find_robot(options["robot"]), _wall_height(options["walls"]))

    def top_view(self, instance: Any, options: Options, state: State) -> tuple[Shape, ...]:  # noqa: ARG002  # the same for all
        """The basket, the boxes, and what is in the way."""
        from llm3_boxpack.top_view import top_view

        return top_view(instance, state)


def _inset(center: float, side: float, width: float) -> tuple[float, float]:
    """Where along a side the centre of something of this width can be; the middle if it is too wide."""
    room = max(0.0, side - width) / 2
    return center - room, center + room


def _wall_height(text: str) -> float | None:
    """The height in metres; None for the problem's own."""
    if text == OWN_WALLS:
        return None
    try:
        height = float(text)
    except ValueError:
        height = -1.0
    if not 0.0 <= height <= MAX_WALL_HEIGHT:
        raise UsageError(
            f"option 'walls' must be a height from 0 to {MAX_WALL_HEIGHT:g} m or {OWN_WALLS}, not {text!r}."
        )
    return height
