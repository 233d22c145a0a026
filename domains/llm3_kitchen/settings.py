"""The settings: how much is to be served, from among how much clutter. What stands where is drawn from a seed."""

from __future__ import annotations

from llm3.seeding import generator
from llm3_bullet.scene import Size
from llm3_kitchen.instance import ClutterSpec, FoodSpec, KitchenInstance, PlaceSpec
from llm3_kitchen.store import filled

PLACES = (
    PlaceSpec("store", "store", (0.60, 0.0), (0.24, 0.66)),
    PlaceSpec("sink", "sink", (0.38, 0.38), (0.18, 0.16)),
    PlaceSpec("stove", "stove", (0.38, -0.38), (0.18, 0.16)),
    PlaceSpec("worktop", "worktop", (-0.02, -0.56), (0.50, 0.26)),
    PlaceSpec("serving", "serving", (-0.02, 0.56), (0.50, 0.30)),
)
FOODS: dict[str, Size] = {
    "carrot": (0.12, 0.03, 0.03),
    "leek": (0.15, 0.035, 0.035),
    "cucumber": (0.13, 0.04, 0.04),
    "aubergine": (0.11, 0.055, 0.055),
    "corn": (0.12, 0.045, 0.045),
    "bread": (0.10, 0.065, 0.06),
    "potato": (0.05, 0.05, 0.045),
    "tomato": (0.045, 0.045, 0.04),
}
CLUTTER: dict[str, Size] = {
    "oil_bottle": (0.045, 0.045, 0.16),
    "milk_carton": (0.06, 0.06, 0.14),
    "jam_jar": (0.055, 0.055, 0.11),
    "tea_tin": (0.065, 0.045, 0.13),
    "salt_box": (0.05, 0.04, 0.12),
}
SETTINGS = {"kitchen-3": 3, "kitchen-4": 4, "kitchen-5": 5, "kitchen-6": 6}
"""How much food there is. There is one thing less that is in the way."""
GOALS = ((True, True), (True, False), (False, False))
"""Washed and heated: the foods take turns."""


def generate(setting: str, seed: int) -> KitchenInstance:
    """The instance of a setting, such as ``"kitchen-4"``, and a seed."""
    rng = generator("kitchen", setting, seed)
    count = SETTINGS[setting]
    names = rng.permutation(list(FOODS)).tolist()[:count]
    obstacles = rng.permutation(list(CLUTTER)).tolist()[: count - 1]
    spots = filled(PLACES[0].area, {n: FOODS[n] for n in names}, {n: CLUTTER[n] for n in obstacles}, rng)
    foods = (
        FoodSpec(name, FOODS[name], *spots[name], washed, heated)
        for name, (washed, heated) in zip(names, GOALS * count, strict=False)
    )
    clutter = (ClutterSpec(name, CLUTTER[name], *spots[name]) for name in obstacles)
    return KitchenInstance(PLACES, tuple(foods), tuple(clutter))
