"""The kitchen domain, as the framework sees it."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

from llm3.interfaces import Options, PlanVerifier, Regions, StandIn
from llm3.types import Action, Shape, Sketch, State
from llm3_bullet.tabletop.domain import TabletopDomain
from llm3_kitchen.instance import KitchenInstance
from llm3_kitchen.pieces import pieces
from llm3_kitchen.ranges import regions
from llm3_kitchen.settings import SETTINGS, generate

if TYPE_CHECKING:
    from llm3_bullet.tabletop.env import TabletopEnv
    from llm3_bullet.workcell import Workcell


class Kitchen(TabletopDomain):
    """Prepare a meal: preconditions and things that are in the way, in one task."""

    name = "kitchen"
    description = "An arm fetches food from among clutter, washes, heats and serves it."
    settings = tuple(SETTINGS)
    default_setting = "kitchen-3"
    instance_type = KitchenInstance

    def instance(self, setting: str, seed: int) -> KitchenInstance:
        """What is on the menu, and what stands where, drawn from the seed."""
        return generate(setting, seed).instance

    def witness(self, setting: str, seed: int) -> tuple[Action, ...] | None:
        """Actions that solve it with the default robot; None for the smaller kitchens."""
        return generate(setting, seed).witness

    def env(self, instance: Any, workcell: Workcell, options: Options) -> TabletopEnv:  # noqa: ARG002  # robot: done
        """Food, clutter, places and an arm."""
        from llm3_kitchen.env import KitchenEnv

        return KitchenEnv(instance, workcell)

    def pieces(self, instance: Any) -> tuple[tuple[Sketch, ...], ...]:
        """What is done with each food, and with each thing of the clutter."""
        return pieces(instance)

    def regions(self, instance: Any) -> Regions:
        """For each thing and place the centres at which it fits."""
        return regions(instance)

    def stand_in(self) -> StandIn:
        """Rules of thumb for kitchen work."""
        from llm3_kitchen.stand_in import reply

        return reply

    def verifier(self, instance: Any, options: Options) -> PlanVerifier:
        """A plain PyBullet world, in which a plan is played again."""
        from llm3_bullet.robots import find_robot
        from llm3_kitchen.verification import KitchenVerifier

        return KitchenVerifier(instance, find_robot(options["robot"]))

    def top_view(self, instance: Any, options: Options, state: State) -> tuple[Shape, ...]:  # noqa: ARG002  # the same for all
        """The places, the food and the clutter."""
        from llm3_kitchen.top_view import top_view

        return top_view(instance, state)
