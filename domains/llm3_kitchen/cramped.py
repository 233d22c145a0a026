"""Cramped kitchens, and how meals are made in them.

Half of the food is low, and half of it is tall. Each low food stands in the store between two things that are higher,
sink and stove are taken, and the serving place has just room for all food in a row: the fingers that let go of tall
food pass above the low food beside it, but the hand that lets go of low food would hit tall food beside that.
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from itertools import chain
from math import ceil

import numpy as np

from llm3.types import Action
from llm3_bullet.scene import Size
from llm3_kitchen.columns import PITCH, dealt, standing
from llm3_kitchen.goods import FOODS, MORE_CLUTTER, MORE_FOODS, TALL_FOODS
from llm3_kitchen.instance import ClutterSpec, FoodSpec, KitchenInstance, PlaceSpec
from llm3_kitchen.known import Known, moved, prepared
from llm3_kitchen.meals import GOALS
from llm3_kitchen.ranges import QUARTER
from llm3_kitchen.slots import WORKTOP_PITCH, slots
from llm3_kitchen.store import Spot, rounded

LOW_FOODS: dict[str, Size] = {
    name: size for name, size in {**FOODS, **MORE_FOODS}.items() if 0.12 <= size[0] <= 0.13 and size[2] <= 0.045
}
"""What fits into the small sink, and under the fingers that hold tall food."""
SINK = PlaceSpec("sink", "sink", (0.22, 0.47), (0.15, 0.116))
STOVE = PlaceSpec("stove", "stove", (0.22, -0.47), (0.14, 0.10))
GAP = 0.008
"""Between neighbours in the serving place, in metres."""
MOST_TURNED = 0.15
"""How far the things in the sink and on the stove are turned, in radians."""


def cramped(count: int, rng: np.random.Generator) -> Known:
    """A problem with so much food.

    Args:
        count: How much food there is: an even number up to 8. Half as many things and two are in the way.
        rng: Draws what is on the menu, and what stands where.
    """
    low = rng.permutation(list(LOW_FOODS)).tolist()[: count // 2]
    tall = rng.permutation(list(TALL_FOODS)).tolist()[: count // 2]
    clutter = rng.permutation(list(MORE_CLUTTER)).tolist()[: count // 2 + 2]
    sizes = {**LOW_FOODS, **TALL_FOODS, **MORE_CLUTTER}
    menu = rng.permutation([*low, *tall]).tolist()
    row = list(chain.from_iterable(zip(low, tall, strict=True)))
    places = _places(row, len(tall) + len(clutter), sizes)
    spots = _start(places["store"], low, [*tall, *clutter], sizes, rng)
    foods = tuple(
        FoodSpec(name, sizes[name], *spots[name], washed, heated)
        for name, (washed, heated) in zip(menu, GOALS * count, strict=False)
    )
    in_the_way = tuple(ClutterSpec(name, sizes[name], *spots[name]) for name in clutter)
    instance = KitchenInstance(tuple(places.values()), foods, in_the_way)
    return Known(instance, tuple(_solved(instance, places, row, low)))


def _places(row: list[str], aside: int, sizes: Mapping[str, Size]) -> dict[str, PlaceSpec]:
    """By their kind: room for the row that is to be served, and for what has to be put aside."""
    length = sum(sizes[name][1] for name in row) + GAP * (len(row) + 1)
    places = (
        PlaceSpec("store", "store", (0.54, 0.0), (0.26, round(PITCH * len(row) / 2, 3))),
        SINK,
        STOVE,
        PlaceSpec("worktop", "worktop", (-0.15, -0.57), (round(WORKTOP_PITCH[0] * ceil(aside / 2), 3), 0.23)),
        PlaceSpec("serving", "serving", (-0.17, 0.50), (_even(length), 0.14)),
    )
    return {place.kind: place for place in places}


def _even(length: float) -> float:
    """Not less, and such that both ends are at whole millimetres, as a model reads them."""
    return round(2 * ceil(round(length * 500, 3)) / 1000, 3)


def _start(
    store: PlaceSpec, low: list[str], others: list[str], sizes: Mapping[str, Size], rng: np.random.Generator
) -> dict[str, Spot]:
    """One thing in the sink, one on the stove, and low food between the others in the store."""
    while True:
        in_sink, on_stove, *rest = rng.permutation(others).tolist()
        spots = standing(store.area, dealt(low, rest, len(low)), sizes, rng)
        if spots:
            break
    for name, place in ((in_sink, SINK), (on_stove, STOVE)):
        spots[name] = rounded(*place.center, rng.uniform(-MOST_TURNED, MOST_TURNED))
    return spots


def _solved(
    instance: KitchenInstance, places: dict[str, PlaceSpec], row: list[str], low: list[str]
) -> Iterator[Action]:
    """All but the low food is put aside, the highest first; then the food is served, the lowest first."""
    sizes = {thing.name: thing.size for thing in instance.things}
    worktop, serving = places["worktop"], places["serving"]
    aside = sorted((name for name in sizes if name not in low), key=lambda name: -sizes[name][2])
    for name, spot in zip(aside, slots(worktop.area, (ceil(len(aside) / 2), 2), WORKTOP_PITCH), strict=False):
        yield from moved(name, worktop.name, spot)
    left = serving.center[0] - serving.size[0] / 2
    spots = {}
    for name in row:
        spots[name] = left + GAP + sizes[name][1] / 2, serving.center[1]
        left += GAP + sizes[name][1]
    for food in sorted(instance.foods, key=lambda food: food.size[2]):
        yield from prepared(food, places)
        yield from moved(food.name, serving.name, spots[food.name], QUARTER)
