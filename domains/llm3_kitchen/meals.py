"""The smaller kitchens: food, and clutter close to some of it, anywhere in the store."""

from __future__ import annotations

import numpy as np

from llm3_kitchen.goods import CLUTTER, FOODS
from llm3_kitchen.instance import ClutterSpec, FoodSpec, KitchenInstance, PlaceSpec
from llm3_kitchen.known import Known
from llm3_kitchen.store import filled

PLACES = (
    PlaceSpec("store", "store", (0.60, 0.0), (0.24, 0.66)),
    PlaceSpec("sink", "sink", (0.38, 0.38), (0.18, 0.16)),
    PlaceSpec("stove", "stove", (0.38, -0.38), (0.18, 0.16)),
    PlaceSpec("worktop", "worktop", (-0.02, -0.56), (0.50, 0.26)),
    PlaceSpec("serving", "serving", (-0.02, 0.56), (0.50, 0.30)),
)
GOALS = ((True, True), (True, False), (False, False))
"""Washed and heated: the foods take turns."""


def meal(count: int, rng: np.random.Generator) -> Known:
    """A problem with so much food, of which no solution is known.

    Args:
        count: How much food there is; there is one thing less that is in the way.
        rng: Draws what is on the menu, and what stands where.
    """
    names = rng.permutation(list(FOODS)).tolist()[:count]
    obstacles = rng.permutation(list(CLUTTER)).tolist()[: count - 1]
    spots = filled(PLACES[0].area, {n: FOODS[n] for n in names}, {n: CLUTTER[n] for n in obstacles}, rng)
    foods = (
        FoodSpec(name, FOODS[name], *spots[name], washed, heated)
        for name, (washed, heated) in zip(names, GOALS * count, strict=False)
    )
    clutter = (ClutterSpec(name, CLUTTER[name], *spots[name]) for name in obstacles)
    return Known(KitchenInstance(PLACES, tuple(foods), tuple(clutter)))
