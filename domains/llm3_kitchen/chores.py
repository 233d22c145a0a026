"""Washing and heating: what they need, in sentences."""

from __future__ import annotations

from llm3.types import Failure, NoMotion, State
from llm3_bullet.tabletop.manipulation import precondition
from llm3_kitchen.facts import HEATED, WASHED, is_true
from llm3_kitchen.instance import KitchenInstance
from llm3_kitchen.whereabouts import place_of

VERBS = {WASHED: "wash", HEATED: "heat"}
NEEDED = {WASHED: "sink", HEATED: "stove"}
"""The kind of place in which food is washed, and heated."""


def chore(instance: KitchenInstance, state: State, name: str, deed: str) -> NoMotion | Failure:
    """Nothing moves, or the precondition that is not met.

    Args:
        instance: The problem.
        state: Where it begins.
        name: What is to be washed or heated.
        deed: `WASHED` or `HEATED`.
    """
    verb, kind = VERBS[deed], NEEDED[deed]
    food = next((food for food in instance.foods if food.name == name), None)
    if food is None:
        return precondition(f"{name} is no food, so there is no need to {verb} it.", name)
    if state.held:
        held = state.held.object
        it = "it" if held == name else held
        return precondition(f"The gripper holds {held}, so it cannot {verb} {name}: put {it} down first.")
    place = place_of(instance, state, name, food.size)
    if place is None or place.kind != kind:
        where = f"stands in {place.name}" if place else "stands in no place with its whole footprint"
        return precondition(f"{name} {where}, so it cannot be {deed}: {_first(instance, kind)}.", name)
    if deed == HEATED and not is_true(state, name, WASHED):
        return precondition(f"{name} is not washed, so it cannot be heated: wash it first.", name)
    return NoMotion()


def _first(instance: KitchenInstance, kind: str) -> str:
    names = [place.name for place in instance.of_kind(kind)]
    return f"place it in {' or '.join(names)} first" if names else f"there is no {kind} here"
