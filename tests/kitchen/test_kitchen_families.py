"""The larger and the cramped kitchens: what they promise, and that their solutions are ones, by geometry alone."""

from __future__ import annotations

import re
from dataclasses import dataclass
from itertools import combinations
from math import cos, pi, sin

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from llm3.jsonio import dumps
from llm3.types import Action
from llm3_bullet.tabletop.rectangles import Rectangle
from llm3_kitchen.cramped import LOW_FOODS
from llm3_kitchen.domain import Kitchen
from llm3_kitchen.goods import TALL_FOODS
from llm3_kitchen.instance import MOST_THINGS, KitchenInstance
from llm3_kitchen.settings import CRAMPED, FEASTS, MEALS, generate
from llm3_kitchen.store import SNUG

FAMILIES = {**FEASTS, **CRAMPED}
families = st.sampled_from(tuple(FAMILIES))
seeds = st.integers(0, 10**6)
some = settings(max_examples=15)

MARGIN = 0.003
PALM = (0.104 + MARGIN, 0.0316 + MARGIN)
"""How far the palm of the default robot reaches from the middle of what it takes, as the fingers close and across."""
FINGER = (0.004 + 0.0264 + MARGIN, 0.0105 + MARGIN)
"""How far an open finger reaches out from the face that it takes, and to either side of the middle."""


@dataclass(frozen=True)
class Standing:
    """A thing where it stands."""

    size: tuple[float, float, float]
    spot: tuple[float, float]
    yaw: float

    def around(self, length: float, width: float, along: float = 0.0) -> Rectangle:
        """A rectangle along the direction in which fingers close on the thing's closer faces, moved along it."""
        yaw = self.yaw + pi / 2
        x, y = self.spot
        return Rectangle((x + along * cos(yaw), y + along * sin(yaw)), (length, width), (cos(yaw), sin(yaw)))

    @property
    def footprint(self) -> Rectangle:
        return Rectangle(self.spot, self.size[:2], (cos(self.yaw), sin(self.yaw)))

    @property
    def tool(self) -> float:
        """How high the fingers hold it, above what it stands on."""
        half = self.size[2] / 2
        return half + max(min(0.012, half / 2), half + 0.005 - 0.039)

    def in_the_way(self, other: Standing) -> bool:
        """Whether something else is in the way of the hand, or so close to it that it might be."""
        width = self.size[1]
        fingers = [self.around(FINGER[0], 2 * FINGER[1], side * (width + FINGER[0]) / 2) for side in (-1, 1)]
        hits_finger = any(finger.overlaps(other.footprint) for finger in fingers)
        hits_palm = self.around(2 * PALM[0], 2 * PALM[1]).overlaps(other.footprint)
        tips, palm = self.tool - 0.0072, self.tool + 0.039
        return (hits_finger and other.size[2] > tips - MARGIN) or (hits_palm and other.size[2] > palm - MARGIN / 3)


def start_of(instance: KitchenInstance) -> dict[str, Standing]:
    return {thing.name: Standing(thing.size, thing.position, thing.yaw) for thing in instance.things}


def witness_of(setting: str, seed: int) -> tuple[Action, ...]:
    found = Kitchen().witness(setting, seed)
    assert found is not None
    return found


@some
@given(families, seeds)
def test_the_solution_is_one_and_nothing_is_ever_in_the_way_of_the_hand(setting, seed):
    instance = Kitchen().instance(setting, seed)
    places = {place.name: place for place in instance.places}
    table, done, held = start_of(instance), set(), None
    for action in witness_of(setting, seed):
        name, *where = action.objects
        if action.name == "pick":
            assert held is None
            held = table.pop(name)
            assert held.size[0] >= held.size[1]
            assert not [other for other, thing in table.items() if held.in_the_way(thing)]
        elif action.name == "place":
            assert held is not None
            put = Standing(held.size, (action.params["x"], action.params["y"]), action.params["theta"])
            assert places[where[0]].holds(put.footprint)
            assert not [other for other, thing in table.items() if put.in_the_way(thing)]
            assert not [other for other, thing in table.items() if put.around(*grown(put)).overlaps(thing.footprint)]
            table[name], held = put, None
        else:
            kind = {"wash": "sink", "heat": "stove"}[action.name]
            assert places[kind].holds(table[name].footprint)
            assert action.name == "wash" or (name, "wash") in done
            done.add((name, action.name))
    asked = {(f.name, "wash") for f in instance.foods if f.washed} | {
        (f.name, "heat") for f in instance.foods if f.heated
    }
    assert asked <= done
    assert all(places["serving"].holds(table[food.name].footprint) for food in instance.foods)


def grown(thing: Standing) -> tuple[float, float]:
    """Its sides across and along its own x, with a little room around."""
    return thing.size[1] + 2 * MARGIN, thing.size[0] + 2 * MARGIN


@some
@given(families, seeds)
def test_the_start_is_one_in_which_nothing_touches(setting, seed):
    instance = Kitchen().instance(setting, seed)
    for one, other in combinations(start_of(instance).values(), 2):
        assert not one.around(one.size[1] + SNUG[0] / 2, one.size[0] + SNUG[0] / 2).overlaps(other.footprint)


@some
@given(families, seeds)
def test_instance_and_solution_come_from_one_draw_and_the_solution_is_not_told(setting, seed):
    known = generate(setting, seed)
    assert Kitchen().instance(setting, seed) == known.instance
    assert Kitchen().witness(setting, seed) == known.witness
    told = set(re.findall(r'"(\w+)":', dumps(known.instance)))
    assert told == {
        *("places", "foods", "clutter", "name", "kind", "center"),
        *("size", "position", "yaw", "washed", "heated"),
    }


@pytest.mark.parametrize("setting", MEALS)
def test_the_smaller_kitchens_have_no_known_solution(setting):
    assert Kitchen().witness(setting, 0) is None


@some
@given(families, seeds)
def test_there_is_as_much_food_as_the_name_says(setting, seed):
    instance = Kitchen().instance(setting, seed)
    assert len(instance.foods) == FAMILIES[setting] == int(setting.rpartition("-")[2])
    assert len(instance.clutter) == (len(instance.foods) - 1 if setting in FEASTS else len(instance.foods) // 2 + 2)
    assert len(instance.things) <= MOST_THINGS
    assert {(True, True), (True, False), (False, False)} == {(food.washed, food.heated) for food in instance.foods}


@some
@given(families, seeds)
def test_what_a_model_reads_to_the_millimetre_is_what_there_is(setting, seed):
    instance = Kitchen().instance(setting, seed)
    edges = [
        middle + side * half / 2
        for place in instance.places
        for middle, half in zip(place.center, place.size, strict=True)
        for side in (-1, 1)
    ]
    for length in (*edges, *(value for thing in instance.things for value in thing.position)):
        assert length == pytest.approx(round(length, 3), abs=1e-9)


@some
@given(st.sampled_from(tuple(CRAMPED)), seeds)
def test_in_a_cramped_kitchen_all_is_taken_and_low_food_is_closed_in_from_both_sides(setting, seed):
    instance = Kitchen().instance(setting, seed)
    start = start_of(instance)
    low = {food.name for food in instance.foods if food.name in LOW_FOODS}
    tall = {food.name for food in instance.foods if food.name in TALL_FOODS}
    assert len(low) == len(tall) == len(instance.foods) // 2
    for kind in ("sink", "stove"):
        (place,) = instance.of_kind(kind)
        (inside,) = [name for name, thing in start.items() if place.holds(thing.footprint)]
        assert inside not in low
    for name in low:
        around = [other for other, thing in start.items() if other != name and start[name].in_the_way(thing)]
        sides = {side_of(start[name], start[other]) for other in around}
        assert sides == {-1, 1}
        assert not low & set(around)


def side_of(thing: Standing, other: Standing) -> int:
    """On which of its long sides something else stands."""
    across = (-sin(thing.yaw), cos(thing.yaw))
    return 1 if sum((b - a) * c for a, b, c in zip(thing.spot, other.spot, across, strict=True)) > 0 else -1


@some
@given(st.sampled_from(tuple(CRAMPED)), seeds)
def test_in_a_cramped_kitchen_tall_food_that_is_served_first_keeps_low_food_out(setting, seed):
    """Where the solution puts it: each low food has a tall neighbour in whose company the hand cannot let go of it."""
    instance = Kitchen().instance(setting, seed)
    served = {
        action.objects[0]: Standing(
            next(thing.size for thing in instance.things if thing.name == action.objects[0]),
            (action.params["x"], action.params["y"]),
            action.params["theta"],
        )
        for action in witness_of(setting, seed)
        if action.objects[1:] == ("serving",)
    }
    low = set(served) & set(LOW_FOODS)
    for name in low:
        assert any(served[name].in_the_way(served[other]) for other in set(served) - low)
