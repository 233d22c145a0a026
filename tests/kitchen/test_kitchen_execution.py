"""Meals are served with motors, friction and gravity; what is no motion is asked of the kitchen where things are."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest
from kitchen_world import BREAD, POTATO

from llm3.types import Action, Motion, Noise, PlannedAction
from llm3_bullet.tabletop.executor import TabletopExecutor
from llm3_kitchen.domain import Kitchen
from llm3_kitchen.instance import KitchenInstance
from llm3_kitchen.meals import PLACES


def washed(env, position):
    """The wash of a potato that stands there, carried out."""
    state = env.reset()
    pose = replace(state.poses["potato"], position=(*position, state.poses["potato"].position[2]))
    start = replace(state, poses={**state.poses, "potato": pose})
    wash = PlannedAction(Action("wash", ("potato",)), Motion(), start)
    return TabletopExecutor(env, Noise()).execute(start, (wash,), np.random.default_rng(0))


def test_what_a_chore_changes_is_asked_of_where_things_really_are(make):
    env = make(KitchenInstance(PLACES, (POTATO, BREAD)))
    (sink,) = (place for place in PLACES if place.kind == "sink")
    there, elsewhere = washed(env, sink.area.center), washed(env, (0.5, 0.0))
    assert there.state.facts["potato washed"]
    assert there.actions[0].slips == ()
    assert not elsewhere.state.facts["potato washed"]
    (slip,) = elsewhere.actions[0].slips
    assert slip.sentence == (
        "it could not be done: potato stands in no place with its whole footprint, so it cannot be washed: place it in "
        "sink first."
    )


@pytest.mark.slow
@pytest.mark.parametrize("setting", ["kitchen-3", "kitchen-4"])
def test_a_meal_is_served(solve, setting):
    seed = 0
    result, plan, _ = solve(setting=setting, seed=seed)
    assert result.solved
    domain = Kitchen()
    executor = domain.executor(domain.instance(setting, seed), plan.options, Noise())
    execution = executor.execute(plan.start, plan.actions, np.random.default_rng(0))
    executor.close()
    world = domain.make(domain.instance(setting, seed), plan.options)
    goal = world.goal(execution.state)
    world.close()
    assert goal.achieved
