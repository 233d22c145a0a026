"""The stand-in where the prompt tells how high the hand is: it reckons with geometry."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from packing_world import box, problem

from llm3.parsing import parse_reply
from llm3.solve import context_of
from llm3.types import Action, Context, Failure, FailureKind, Proposal, Sketch
from llm3_boxpack.domain import BoxPack
from llm3_boxpack.instance import BoxpackInstance
from llm3_boxpack.stand_in import reply

BAR = (0.05, 0.09, 0.06)
WALLED = replace(
    problem(box("red_box", 0.4, 0.35, BAR), box("blue_box", 0.5, -0.4, (0.08, 0.05, 0.06))).with_walls(0.05)
)
seeds = st.integers(0, 2**32)


def plan(context: Context, seed: int) -> tuple[Action, ...]:
    proposal = parse_reply(reply(context, np.random.default_rng(seed)), context.actions, context.objects)
    assert isinstance(proposal, Proposal), proposal
    assert proposal.reasoning
    return tuple(action for action in proposal.actions if isinstance(action, Action))


def context(make, instance: BoxpackInstance) -> Context:
    env = make(instance, None)
    return context_of(env, env.reset())


@settings(max_examples=10, deadline=None)
@given(seeds)
def test_with_room_for_all_it_packs_all_at_once_and_each_pick_is_followed_by_its_place(make, seed):
    actions = plan(context(make, WALLED), seed)
    assert sorted(action.objects[0] for action in actions[::2]) == ["blue_box", "red_box"]
    assert [action.name for action in actions] == ["pick", "place"] * 2
    assert [action.objects for action in actions[::2]] == [action.objects for action in actions[1::2]]


@pytest.mark.parametrize("setting", ["far-4", "clutter-4", "lanes-4"])
def test_what_it_proposes_works(solve, setting):
    """A plan may leave boxes out, and then misses the goal; but none of its actions fails for the geometry."""
    result, _ = solve(setting=setting, seed=0, llm="offline", max_llm_calls=2)
    failures = [outcome.failure for attempt in result.attempts for outcome in attempt.outcomes]
    assert not [f for f in failures if isinstance(f, Failure) and f.kind is not FailureKind.NO_PATH]


def test_it_solves_a_problem_with_clutter_and_the_plan_is_sound(solve):
    result, _ = solve(setting="clutter-4", seed=0, llm="offline", max_llm_calls=20)
    assert result.solved
    moved = {step.action.objects[0] for step in result.plan}
    assert moved > {spec.name for spec in BoxPack().instance("clutter-4", 0).boxes}


def test_the_same_generator_gives_the_same_reply(make):
    told = context(make, BoxPack().instance("lanes-4", 1))
    assert reply(told, np.random.default_rng(3)) == reply(told, np.random.default_rng(3))


def test_boxes_that_start_in_the_basket_stay_there(make):
    instance = replace(WALLED, boxes=(*WALLED.boxes, box("green_box", 0.65, 0.0, (0.04, 0.06, 0.06))))
    assert "green_box" not in {action.objects[0] for action in plan(context(make, instance), 0)}


def test_with_a_given_sequence_it_goes_by_experience(make):
    sketches = tuple(Sketch(name, (spec.name,)) for spec in WALLED.boxes for name in ("pick", "place"))
    given_ = replace(context(make, WALLED), skeleton=sketches)
    actions = plan(given_, 0)
    assert tuple(Sketch(action.name, action.objects) for action in actions) == sketches


def test_a_box_too_large_for_what_is_left_is_left_out_and_the_reasoning_says_so(make):
    """Three bars of which two fit: the basket has room for all three by their area alone."""
    wide = [box(f"{name}_box", 0.45, y, (0.07, 0.19, 0.06)) for name, y in (("red", 0.4), ("blue", -0.4))]
    instance = problem(*wide, box("green_box", 0.3, 0.6, (0.07, 0.19, 0.06))).with_walls(0.05)
    told = context(make, instance)
    text = reply(told, np.random.default_rng(0))
    assert "I see no room for" in text
    assert len(plan(told, 0)) < 6
