"""The larger kitchens: much food in columns with clutter between, and a solution."""

from __future__ import annotations

from collections.abc import Iterator
from math import ceil

import numpy as np

from llm3.types import Action
from llm3_kitchen.columns import dealt, standing
from llm3_kitchen.goods import CLUTTER, FOODS, MORE_CLUTTER, MORE_FOODS
from llm3_kitchen.instance import ClutterSpec, FoodSpec, KitchenInstance, PlaceSpec
from llm3_kitchen.known import Known, moved, prepared
from llm3_kitchen.meals import GOALS
from llm3_kitchen.ranges import QUARTER
from llm3_kitchen.slots import WORKTOP_PITCH, slots

PLACES = (
    PlaceSpec("store", "store", (0.54, 0.0), (0.32, 0.80)),
    PlaceSpec("sink", "sink", (0.22, 0.47), (0.18, 0.16)),
    PlaceSpec("stove", "stove", (0.22, -0.47), (0.18, 0.16)),
    PlaceSpec("worktop", "worktop", (-0.15, -0.57), (0.50, 0.26)),
    PlaceSpec("serving", "serving", (-0.20, 0.53), (0.54, 0.32)),
)
COLUMNS = 4
SERVING_PITCH = (0.104, 0.16)
"""From slot to slot in the serving place, in metres, for food whose long sides are along y: half of the food on both
sides and a finger between along x, the longest food along y."""
ALL_FOODS = {**FOODS, **MORE_FOODS}
ALL_CLUTTER = {name: size for name, size in {**CLUTTER, **MORE_CLUTTER}.items() if size[0] > size[1]}


def feast(count: int, rng: np.random.Generator) -> Known:
    """A problem with so much food.

    Args:
        count: How much food there is, at most 10; there is one thing less that is in the way.
        rng: Draws what is on the menu, and what stands where.
    """
    names = rng.permutation(list(ALL_FOODS)).tolist()[:count]
    obstacles = rng.permutation(list(ALL_CLUTTER)).tolist()[: count - 1]
    sizes = {**ALL_FOODS, **ALL_CLUTTER}
    while True:
        columns = dealt(rng.permutation(names).tolist(), rng.permutation(obstacles).tolist(), COLUMNS)
        spots = standing(PLACES[0].area, columns, sizes, rng)
        if spots:
            break
    foods = tuple(
        FoodSpec(name, sizes[name], *spots[name], washed, heated)
        for name, (washed, heated) in zip(names, GOALS * count, strict=False)
    )
    clutter = tuple(ClutterSpec(name, sizes[name], *spots[name]) for name in obstacles)
    instance = KitchenInstance(PLACES, foods, clutter)
    return Known(instance, tuple(_solved(instance)))


def _solved(instance: KitchenInstance) -> Iterator[Action]:
    """First the clutter, then the food; the highest first, so that the hand is above all that is left in the store."""
    places = {place.kind: place for place in instance.places}
    worktop, serving = places["worktop"], places["serving"]
    aside = slots(worktop.area, (ceil(len(instance.clutter) / 2), 2), WORKTOP_PITCH)
    for thing, spot in zip(sorted(instance.clutter, key=lambda thing: -thing.size[2]), aside, strict=False):
        yield from moved(thing.name, worktop.name, spot)
    served = slots(serving.area, (ceil(len(instance.foods) / 2), 2), SERVING_PITCH)
    for food, spot in zip(sorted(instance.foods, key=lambda food: -food.size[2]), served, strict=False):
        yield from prepared(food, places)
        yield from moved(food.name, serving.name, spot, QUARTER)
