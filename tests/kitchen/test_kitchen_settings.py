"""What the smaller kitchens hold: how much, what is to be done with it, and that clutter is really in the way."""

from __future__ import annotations

from dataclasses import replace
from hashlib import sha256
from itertools import combinations

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from kitchen_world import pick

from llm3.jsonio import dumps
from llm3.types import Failure, FailureKind
from llm3_kitchen.domain import Kitchen
from llm3_kitchen.settings import MEALS, SETTINGS
from llm3_kitchen.store import FINGER_ROOM

each_setting = st.sampled_from(tuple(SETTINGS))
each_meal = st.sampled_from(tuple(MEALS))
seeds = st.integers(0, 10**6)
some = settings(max_examples=8)


@some
@given(each_setting, seeds)
def test_the_same_seed_gives_the_same_kitchen_and_another_one_another(setting, seed):
    instance = Kitchen().instance(setting, seed)
    assert Kitchen().instance(setting, seed) == instance
    assert Kitchen().instance(setting, seed + 1) != instance


def test_what_a_seed_meant_in_earlier_runs_it_still_means():
    told = "".join(dumps(Kitchen().instance(setting, seed)) for setting in MEALS for seed in range(5))
    assert sha256(told.encode()).hexdigest() == "219b54d1025e71cd77afbdd5a7f22ef6395a162e9091eba2666b5890571931ce"


@some
@given(each_meal, seeds)
def test_there_is_as_much_food_as_the_name_says_and_one_thing_less_in_the_way(setting, seed):
    instance = Kitchen().instance(setting, seed)
    assert setting == f"kitchen-{len(instance.foods)}"
    assert len(instance.clutter) == len(instance.foods) - 1


@some
@given(each_meal, seeds)
def test_some_food_is_to_be_heated_some_washed_and_some_only_served(setting, seed):
    asked = {(food.washed, food.heated) for food in Kitchen().instance(setting, seed).foods}
    assert asked == {(True, True), (True, False), (False, False)}


@some
@given(each_meal, seeds)
def test_everything_starts_in_the_store_with_room_for_a_finger_between_foods(setting, seed):
    instance = Kitchen().instance(setting, seed)
    (store,) = instance.of_kind("store")
    assert all(store.holds(thing.footprint) for thing in instance.things)
    for one, other in combinations(instance.foods, 2):  # the room is around the one that came later to the store
        assert not (_with_room(one).overlaps(other.footprint) and _with_room(other).overlaps(one.footprint))


def _with_room(food):
    return replace(food.footprint, size=tuple(side + 2 * FINGER_ROOM - 0.002 for side in food.size[:2]))


@some
@given(each_meal, seeds)
def test_clutter_is_higher_than_food(setting, seed):
    """So the hand can always take what is highest, and a way to begin exists."""
    instance = Kitchen().instance(setting, seed)
    assert min(thing.size[2] for thing in instance.clutter) > max(food.size[2] for food in instance.foods) + 0.03


@pytest.mark.parametrize("seed", range(4))
@pytest.mark.parametrize("setting", MEALS)
def test_food_is_out_of_reach_until_clutter_is_gone(make, setting, seed):
    instance = Kitchen().instance(setting, seed)
    answers = first_answers(make(instance), [food.name for food in instance.foods])
    blocked = {name: answer for name, answer in answers.items() if isinstance(answer, Failure)}
    assert blocked
    clutter = {thing.name for thing in instance.clutter}
    for failure in blocked.values():
        assert failure.kind is FailureKind.GOAL_IN_COLLISION
        assert clutter & {contact.object for contact in failure.contacts}
    cleared = make(replace(instance, clutter=()))
    assert not any(isinstance(answer, Failure) for answer in first_answers(cleared, list(blocked)).values())


def first_answers(env, names):
    """What the Env says of picking each of them first."""
    return {name: env.prepare(env.reset(), pick(name), np.random.default_rng(0)) for name in names}
