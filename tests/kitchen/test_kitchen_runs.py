"""Whole runs: meals are served, a second look finds nothing wrong with them, and they can be repeated."""

from __future__ import annotations

from dataclasses import replace

import pytest
from kitchen_world import BREAD, POTATO

from llm3.budget import Budget
from llm3.interfaces import PlannerSettings
from llm3.jsonio import dumps
from llm3.search import search
from llm3_birrt.planner import BiRRT
from llm3_kitchen.domain import Kitchen
from llm3_kitchen.goods import CLUTTER, FOODS, MORE_CLUTTER, MORE_FOODS, TALL_FOODS
from llm3_kitchen.instance import KitchenInstance
from llm3_kitchen.looks import COLORS
from llm3_kitchen.meals import PLACES
from llm3_kitchen.settings import MEALS

PANDA, IIWA = {"robot": "panda"}, {"robot": "iiwa"}


def served(solve, **config) -> None:
    result, plan, defects = solve(**config)
    assert result.solved
    assert defects == ()
    assert {step.action.name for step in plan.actions} == {"pick", "place", "wash", "heat"}


def test_the_stand_in_serves_a_meal(solve):
    served(solve, setting="kitchen-3", seed=0)


@pytest.mark.slow
@pytest.mark.parametrize("seed", range(10))
@pytest.mark.parametrize("setting", MEALS)
def test_the_stand_in_serves_every_meal(solve, setting, seed):
    served(solve, setting=setting, seed=seed)


@pytest.mark.slow
@pytest.mark.parametrize("feedback", ["binary", "none"])
def test_it_works_with_every_feedback_level(solve, feedback):
    result, _, _ = solve(setting="kitchen-3", seed=0, feedback=feedback, max_llm_calls=4)
    assert len(result.attempts) > 1
    assert not any(attempt.unreadable for attempt in result.attempts)


@pytest.mark.slow
def test_another_arm_serves_a_meal(solve):
    served(solve, setting="kitchen-4", seed=0, options=IIWA)


def test_the_search_finds_its_way_where_there_is_little_to_do(make):
    potato = replace(POTATO, washed=False)
    env = make(KitchenInstance(PLACES, (potato, BREAD)))
    regions = Kitchen().regions(KitchenInstance(PLACES, (potato, BREAD)))
    result = search(env, planner=BiRRT(PlannerSettings()), regions=regions, budget=Budget(max_motion_calls=200))
    assert result.solved


@pytest.mark.slow
def test_the_same_seed_gives_the_same_plan(solve):
    assert dumps(solve(seed=3)[1]) == dumps(solve(seed=3)[1])


def test_what_is_there_has_its_colours_in_pictures():
    assert {*FOODS, *MORE_FOODS, *TALL_FOODS, *CLUTTER, *MORE_CLUTTER, "stove"} <= set(COLORS)


def test_a_world_made_out_of_another_answers_like_a_new_one():
    domain = Kitchen()
    old, new = (domain.instance(setting, 1) for setting in ("kitchen-4", "kitchen-3"))
    fresh = domain.make(new, PANDA)
    again = domain.remake(domain.make(old, PANDA), new, PANDA)
    assert again is not None
    assert again.reset() == fresh.reset()
    assert again.describe(again.reset()) == fresh.describe(fresh.reset())
    fresh.close()
    assert domain.remake(again, new, IIWA) is None
    again.close()
