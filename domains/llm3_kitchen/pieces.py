"""What a solution consists of where nobody knows the order: what is done with each thing."""

from __future__ import annotations

from collections.abc import Iterator

from llm3.types import Sketch
from llm3_kitchen.actions import PICK, PLACE
from llm3_kitchen.instance import FoodSpec, KitchenInstance, PlaceSpec
from llm3_kitchen.known import DEEDS

ASIDE = ("worktop", "store")
"""The kinds of places to which clutter is brought, the first one that there is."""


def pieces(instance: KitchenInstance) -> tuple[tuple[Sketch, ...], ...]:
    """For each food the way to where it is served, for each thing of the clutter a way out of the way.

    Food that starts in the first place that it needs is not brought there, and where there is neither a worktop nor a
    store, clutter stays.
    """
    foods = (tuple(_served(instance, food)) for food in instance.foods if food.name in instance.to_move)
    aside = next((place for kind in ASIDE for place in instance.of_kind(kind)), None)
    clutter = (tuple(_moved(thing.name, aside)) for thing in instance.clutter) if aside else ()
    return (*foods, *clutter)


def _served(instance: KitchenInstance, food: FoodSpec) -> Iterator[Sketch]:
    where = instance.place_of(food.footprint)
    for kind in food.needs:
        if where is None or where.kind != kind:
            where = next(p for p in instance.of_kind(kind) if p.area.has_room_for(food.footprint.size))
            yield from _moved(food.name, where)
        if kind in DEEDS:
            yield Sketch(DEEDS[kind], (food.name,))


def _moved(name: str, place: PlaceSpec) -> Iterator[Sketch]:
    yield Sketch(PICK.name, (name,))
    yield Sketch(PLACE.name, (name, place.name))
