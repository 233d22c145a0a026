"""A problem together with actions that solve it."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass

from llm3.types import Action
from llm3_bullet.tabletop.rectangles import Point
from llm3_kitchen.actions import HEAT, PICK, PLACE, WASH
from llm3_kitchen.instance import FoodSpec, KitchenInstance, PlaceSpec

DEEDS = {"sink": WASH.name, "stove": HEAT.name}
"""What is done to food, by the kind of place."""


@dataclass(frozen=True)
class Known:
    """What a generator makes."""

    instance: KitchenInstance
    witness: tuple[Action, ...] | None = None
    """Actions that solve it; None where the generator knows none."""


def moved(name: str, where: str, spot: Point, theta: float = 0.0) -> Iterator[Action]:
    """Take a thing and put it down.

    Args:
        name: The thing's.
        where: The place's name.
        spot: x, y of the thing's centre then, in metres.
        theta: Its rotation about the vertical then, in radians.
    """
    yield Action(PICK.name, (name,))
    x, y = (round(value, 4) for value in spot)
    yield Action(PLACE.name, (name, where), {"x": x, "y": y, "theta": theta})


def prepared(food: FoodSpec, places: dict[str, PlaceSpec]) -> Iterator[Action]:
    """Have done with food all that it needs before it is served, in the middle of each place.

    Args:
        food: The food.
        places: By their kind.
    """
    for kind in food.needs[:-1]:
        yield from moved(food.name, places[kind].name, places[kind].center)
        yield Action(DEEDS[kind], (food.name,))
