"""The domain of towers, as the framework sees it."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

from llm3.interfaces import Options, PlanVerifier, Regions, StandIn
from llm3.types import Action, Shape, Sketch, State
from llm3_blocks.actions import PLACE
from llm3_blocks.cubes import START_X, START_Y
from llm3_blocks.instance import BlocksInstance
from llm3_blocks.sequence import sequence
from llm3_blocks.settings import LARGE, SETTINGS, generate
from llm3_blocks.solution import steps
from llm3_bullet.tabletop.domain import TabletopDomain

if TYPE_CHECKING:
    from llm3_bullet.tabletop.env import TabletopEnv
    from llm3_bullet.workcell import Workcell

MANY = 6
"""More blocks than this need more of the table than where towers start."""
REACH_X, REACH_Y = (0.0, 0.7), (-0.7, 0.7)
"""In metres."""


class Blocks(TabletopDomain):
    """Build towers out of blocks."""

    name = "blocks"
    description = "An arm builds towers of blocks on a table."
    settings = SETTINGS
    default_setting = "blocks-4"
    instance_type = BlocksInstance

    def instance(self, setting: str, seed: int) -> BlocksInstance:
        """Towers drawn from the seed, those at the start and those of the goal."""
        return generate(setting, seed).instance

    def witness(self, setting: str, seed: int) -> tuple[Action, ...] | None:
        """What the generator knows to solve it, for the settings that were made with one."""
        return generate(setting, seed).witness if setting in LARGE else None

    def env(self, instance: Any, workcell: Workcell, options: Options) -> TabletopEnv:  # noqa: ARG002  # the robot's only
        """Blocks, a table and an arm."""
        from llm3_blocks.env import BlocksEnv

        return BlocksEnv(instance, workcell)

    def skeleton(self, instance: Any) -> tuple[Sketch, ...]:
        """What is in the way to the table, and each block to where it belongs; all in step where towers are close."""
        if instance.close:
            return steps(instance)
        return sequence(instance.start, {on.block: on.below for on in instance.goal})

    def regions(self, instance: Any) -> Regions:
        """The part of the table where towers start, too, or where that would not do, what the arm reaches."""
        many = len(instance.blocks) > MANY
        ranges = (("x", REACH_X if many else START_X), ("y", REACH_Y if many else START_Y))
        return {(PLACE.name, (block.name,), axis): range_ for block in instance.blocks for axis, range_ in ranges}

    def stand_in(self) -> StandIn:
        """Rules of thumb for building towers."""
        from llm3_blocks.stand_in import reply

        return reply

    def verifier(self, instance: Any, options: Options) -> PlanVerifier:
        """A plain PyBullet world, in which a plan is played again."""
        from llm3_blocks.verification import BlocksVerifier
        from llm3_bullet.robots import find_robot

        return BlocksVerifier(instance, find_robot(options["robot"]))

    def top_view(self, instance: Any, options: Options, state: State) -> tuple[Shape, ...]:  # noqa: ARG002  # the same for all
        """The blocks."""
        from llm3_blocks.top_view import top_view

        return top_view(instance, state)
