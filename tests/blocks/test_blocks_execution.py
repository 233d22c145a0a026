"""Towers are built with motors, friction and gravity."""

from __future__ import annotations

import numpy as np
import pytest

from llm3.types import Noise
from llm3_blocks.domain import Blocks
from llm3_blocks.settings import SMALL


def stands(solve, **config) -> bool:
    """Whether a plan of the stand-in builds its towers."""
    result, plan = solve(**config)
    assert result.solved
    domain, options = Blocks(), plan.options
    instance = domain.instance(config["setting"], config["seed"])
    executor = domain.executor(instance, options, Noise())
    execution = executor.execute(plan.start, plan.actions, np.random.default_rng(0))
    executor.close()
    world = domain.make(instance, options)
    goal = world.goal(execution.state)
    world.close()
    return goal.achieved


def test_a_tower_stands(solve):
    assert stands(solve, setting="blocks-3", seed=0)


@pytest.mark.slow
@pytest.mark.parametrize("setting", SMALL)
def test_towers_stand(solve, setting):
    assert [seed for seed in range(5) if not stands(solve, setting=setting, seed=seed)] == []
