"""The known solutions of the larger and the cramped kitchens, carried out in their worlds and looked at again."""

from __future__ import annotations

from collections.abc import Callable

import numpy as np
import pytest
from kitchen_world import pick

from llm3.assembly import open_problem
from llm3.interfaces import PlannerSettings
from llm3.rollout import Roller
from llm3.types import Failure, FailureKind
from llm3.witness import witness
from llm3_birrt.planner import BiRRT
from llm3_kitchen.domain import Kitchen
from llm3_kitchen.settings import CRAMPED, FEASTS

FAMILIES = (*FEASTS, *CRAMPED)
Check = Callable[[str, int], None]


@pytest.fixture(scope="module")
def check(make) -> Check:
    """Carries out the solution of a setting and a seed, and sees that it reaches the goal."""

    def solved(setting: str, seed: int) -> None:
        env = make(Kitchen().instance(setting, seed))
        actions = Kitchen().witness(setting, seed)
        assert actions is not None
        rolled = Roller(env, BiRRT(PlannerSettings()), seed, lambda: 0.0).rollout(env.reset(), actions)
        assert [outcome for outcome in rolled.outcomes if outcome.failure] == []
        assert env.goal(rolled.state).achieved

    return solved


def sound(setting: str, seed: int) -> None:
    """A second look finds nothing wrong."""
    domain = Kitchen()
    with open_problem(domain, domain.instance(setting, seed), {}) as problem:
        assert witness(problem, setting, seed, BiRRT(PlannerSettings())).actions


@pytest.mark.parametrize("setting", FAMILIES)
def test_the_known_solution_solves_the_first_problem_of_each_setting(check, setting):
    check(setting, 0)


@pytest.mark.slow
@pytest.mark.parametrize("seed", [1, 2, 3, 1000])
@pytest.mark.parametrize("setting", FAMILIES)
def test_the_known_solution_solves_every_problem(check, setting, seed):
    check(setting, seed)


def test_the_known_solution_is_a_sound_plan():
    sound("cramped-4", 0)


@pytest.mark.slow
@pytest.mark.parametrize("setting", FAMILIES)
def test_the_known_solution_of_every_setting_is_a_sound_plan(setting):
    sound(setting, 1)


@pytest.mark.parametrize("setting", FAMILIES)
def test_some_food_cannot_be_taken_for_the_gripper_alone(make, setting):
    instance = Kitchen().instance(setting, 0)
    env = make(instance)
    start = env.reset()
    answers = [env.prepare(start, pick(food.name), np.random.default_rng(0)) for food in instance.foods]
    refused = [answer for answer in answers if isinstance(answer, Failure)]
    assert refused
    for failure in refused:
        assert failure.kind is FailureKind.GOAL_IN_COLLISION
        assert {contact.part for contact in failure.contacts} <= {"gripper", "arm"}
