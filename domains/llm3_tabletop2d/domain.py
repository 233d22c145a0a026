"""The plane with discs and boxes, as the framework sees it."""

from __future__ import annotations

from typing import Any

from llm3.errors import UsageError
from llm3.interfaces import Domain, Env, Option, Options, PlanVerifier, Regions, Scenery, StandIn
from llm3.types import Shape, Sketch, State
from llm3_tabletop2d.actions import MAX_ACCELERATION, MAX_VELOCITY, skeleton
from llm3_tabletop2d.instance import TabletopInstance
from llm3_tabletop2d.ranges import regions
from llm3_tabletop2d.settings import SETTINGS, generate

MAX_RADIUS = 0.1


class Tabletop2D(Domain):
    """Bring discs and boxes where they belong, in the plane and without a simulator."""

    name = "tabletop2d"
    description = "A disc robot moves discs and boxes in the plane."
    settings = tuple(SETTINGS)
    default_setting = "open"
    options = (Option("robot_radius", "0.03", f"the robot's radius in metres, 0 (a point) to {MAX_RADIUS:g}"),)
    instance_type = TabletopInstance

    def instance(self, setting: str, seed: int) -> TabletopInstance:
        """Sizes and places drawn from the seed."""
        return generate(setting, seed)

    def make(self, instance: Any, options: Options) -> Env:
        """A world; nothing stands behind it."""
        from llm3_tabletop2d.env import TabletopEnv

        return TabletopEnv(instance, _radius(options["robot_radius"]))

    def skeleton(self, instance: Any) -> tuple[Sketch, ...]:
        """What is in the way first, then each object in turn."""
        return skeleton(instance)

    def regions(self, instance: Any) -> Regions:
        """Where the centres of objects can be at all: in their region if they belong in one, or in the room."""
        return regions(instance)

    def stand_in(self) -> StandIn:
        """Rules of thumb for moving things around."""
        from llm3_tabletop2d.stand_in import reply

        return reply

    def verifier(self, instance: Any, options: Options) -> PlanVerifier:
        """A second look with outlines that are made of points."""
        from llm3_tabletop2d.verification import TabletopVerifier

        return TabletopVerifier(instance, _radius(options["robot_radius"]), MAX_VELOCITY, MAX_ACCELERATION)

    def scenery(self, instance: Any, options: Options) -> Scenery:
        """The same as from above, with a height."""
        from llm3_tabletop2d.scenery import TabletopScenery

        return TabletopScenery(instance, _radius(options["robot_radius"]))

    def top_view(self, instance: Any, options: Options, state: State) -> tuple[Shape, ...]:
        """The room, the walls, the regions, the objects and the robot."""
        from llm3_tabletop2d.top_view import top_view

        return top_view(instance, _radius(options["robot_radius"]), state)


def _radius(text: str) -> float:
    try:
        radius = float(text)
    except ValueError:
        radius = -1.0
    if not 0.0 <= radius <= MAX_RADIUS:
        raise UsageError(f"option 'robot_radius' must be a length from 0 to {MAX_RADIUS:g} m, not {text!r}.")
    return radius
