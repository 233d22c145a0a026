"""The search packs boxes, although it knows nothing of them."""

from __future__ import annotations

import pytest

from llm3.records import open_plan
from llm3.registry import Registry
from llm3.verification import verify
from llm3_boxpack.paper_settings import SETTINGS


def test_a_search_packs_the_boxes_and_its_plan_is_sound(solve):
    result, plan = solve(setting="medium-small", seed=2, solver="search", max_motion_calls=200)
    assert result.solved
    assert result.stats.llm_calls == 0
    with open_plan(Registry.discover(), plan) as problem:
        assert verify(problem, plan).sound


def test_a_search_ends_with_its_budget(solve):
    result, _ = solve(setting="hard-small", seed=0, solver="search", max_motion_calls=5)
    assert (result.stop, result.stats.motion_calls) == ("motions", 5)


@pytest.mark.slow
@pytest.mark.parametrize("setting", SETTINGS)
def test_it_solves_every_setting_with_far_fewer_motion_calls_than_random_plans_need(setting, solve):
    results = [solve(setting=setting, seed=seed, solver="search")[0] for seed in range(5)]
    assert all(result.solved for result in results)
    assert sum(result.stats.motion_calls for result in results) / 5 < 663.1 / 2  # the paper's random row, medium-small
