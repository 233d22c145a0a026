"""When the meal is served."""

from __future__ import annotations

from collections.abc import Iterator

from llm3.types import GoalStatus, State
from llm3_kitchen.facts import HEATED, WASHED, is_true
from llm3_kitchen.instance import KitchenInstance
from llm3_kitchen.whereabouts import place_of


def goal_status(instance: KitchenInstance, state: State) -> GoalStatus:
    """Every food is washed and heated as it should be, and stands in a serving place with its whole footprint."""
    unmet = tuple(_unmet(instance, state))
    return GoalStatus(not unmet, unmet)


def _unmet(instance: KitchenInstance, state: State) -> Iterator[str]:
    for food in instance.foods:
        if food.washed and not is_true(state, food.name, WASHED):
            yield f"{food.name} is not washed"
        if food.heated and not is_true(state, food.name, HEATED):
            yield f"{food.name} is not heated"
        place = place_of(instance, state, food.name, food.size)
        if place is None or place.kind != "serving":
            yield f"{food.name} is not served"
