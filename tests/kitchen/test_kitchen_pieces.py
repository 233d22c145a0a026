"""What the random sampler puts in order: a way for each food, and one out of the way for each thing of the clutter."""

from __future__ import annotations

from dataclasses import replace

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from kitchen_world import BOTTLE, BREAD, CARROT, KITCHEN, POTATO, SINK, WORKTOP

from llm3 import BackendSettings, Prompt, solve
from llm3.assembly import RunConfig, assemble
from llm3.budget import Budget
from llm3.errors import MissingCapability
from llm3.interfaces import PlannerSettings
from llm3.registry import Registry
from llm3_birrt.planner import BiRRT
from llm3_kitchen.domain import Kitchen
from llm3_kitchen.instance import KitchenInstance
from llm3_kitchen.meals import PLACES
from llm3_standins.sampler import RandomBackend


def told(instance: KitchenInstance) -> list[str]:
    """Such as ``"pick leek, place leek sink"``."""
    return [
        ", ".join(" ".join((sketch.name, *sketch.objects)) for sketch in piece) for piece in Kitchen().pieces(instance)
    ]


def test_food_is_washed_heated_and_served_and_clutter_goes_to_the_worktop():
    assert told(KITCHEN) == [
        "pick carrot, place carrot sink, wash carrot, pick carrot, place carrot stove, heat carrot, "
        "pick carrot, place carrot serving",
        "pick potato, place potato sink, wash potato, pick potato, place potato serving",
        "pick bread, place bread serving",
        "pick oil_bottle, place oil_bottle worktop",
    ]


def test_what_is_where_it_should_be_stays_there():
    served, in_sink = replace(BREAD, position=(-0.02, 0.56)), replace(POTATO, position=SINK)
    aside = replace(BOTTLE, position=WORKTOP)
    assert told(KitchenInstance(PLACES, (served, in_sink), (aside,))) == [
        "wash potato, pick potato, place potato serving",
        "pick oil_bottle, place oil_bottle worktop",
    ]


def test_without_a_worktop_clutter_is_moved_in_the_store_and_without_that_it_stays():
    no_worktop = tuple(place for place in PLACES if place.kind != "worktop")
    assert told(KitchenInstance(no_worktop, (BREAD,), (BOTTLE,)))[1:] == ["pick oil_bottle, place oil_bottle store"]
    no_store = tuple(place for place in no_worktop if place.kind != "store")
    on_the_stove = replace(BOTTLE, position=(0.38, -0.38))
    in_sink = replace(CARROT, position=SINK)
    assert len(told(KitchenInstance(no_store, (in_sink,), (on_the_stove,)))) == 1


@settings(max_examples=15)
@given(st.sampled_from(Kitchen.settings), st.integers(0, 10**6))
def test_every_sampled_parameter_has_a_range(setting, seed):
    domain = Kitchen()
    instance = domain.instance(setting, seed)
    regions = domain.regions(instance)
    pieces = domain.pieces(instance)
    assert len(pieces) == len(instance.to_move) + len(instance.clutter)
    places = [sketch for piece in pieces for sketch in piece if sketch.name == "place"]
    assert all(("place", sketch.objects, name) in regions for sketch in places for name in ("x", "y", "theta"))


def test_the_sampler_finds_an_order_in_which_a_meal_can_be_served(make):
    domain, registry = Kitchen(), Registry.discover()
    backend = RandomBackend(BackendSettings(pieces=domain.pieces(KITCHEN), regions=domain.regions(KITCHEN)))
    result = solve(
        make(KITCHEN),
        backend=backend,
        planner=BiRRT(PlannerSettings()),
        feedback=registry.feedback("categorized"),
        prompt=Prompt(registry.strategy("scratch")),
        budget=Budget(max_llm_calls=60),
    )
    assert result.solved
    picked = [step.action.objects[0] for step in result.plan if step.action.name == "pick"]
    assert picked.index(BOTTLE.name) < picked.index(CARROT.name)


def test_a_strategy_that_needs_one_sequence_is_refused():
    with pytest.raises(MissingCapability) as error:
        assemble(Registry.discover(), RunConfig("kitchen", llm="random", strategy="sample-params"))
    assert str(error.value) == "domain 'kitchen' has no skeleton, which strategy 'sample-params' needs."
