"""The rule-based stand-in: it reads what a prompt tells, and learns from feedback."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest
from feedback_traces import traces_of
from hypothesis import example, given, settings
from hypothesis import strategies as st
from plane_world import DOMAIN, box, disc, pick, place, problem, push

from llm3.parsing import parse_reply
from llm3.types import Action, Context, Entity, FailureKind, Feedback, Proposal, Remark
from llm3_tabletop2d.env import TabletopEnv
from llm3_tabletop2d.stand_in import reply

CUT_OFF, BLOCKED = FailureKind.UNREACHABLE, FailureKind.GOAL_IN_COLLISION
some = settings(max_examples=25, deadline=None)
seeds = st.integers(0, 2**32)


def context_of(instance) -> Context:
    env = TabletopEnv(instance, 0.03)
    return Context(env.task, env.schemas, env.objects, env.describe(env.reset()))


CONTEXT = context_of(problem(disc("red_disc", 0.3, 0.4), box("grey_box", 0.6, 0.4)))
NAMES = CONTEXT.objects


def plan(context: Context, seed: int = 0) -> tuple[Action, ...]:
    """The plan in the reply; every item of it is a valid action."""
    text = reply(context, np.random.default_rng(seed))
    proposal = parse_reply(text, context.actions, context.objects, context.skeleton)
    assert isinstance(proposal, Proposal), proposal
    assert proposal.repairs == ()
    assert proposal.reasoning
    assert all(isinstance(action, Action) for action in proposal.actions), proposal.actions
    return tuple(action for action in proposal.actions if isinstance(action, Action))


def feedback(number: int, actions: tuple[Action, ...], failed: int, kind: FailureKind | None) -> Feedback:
    """All feasible up to the one that failed."""
    remarks = [Remark(str(action), "feasible") for action in actions[:failed]]
    remarks.append(Remark(str(actions[failed]), "failed", "as it says", kind))
    remarks += [Remark(str(action), "not tried") for action in actions[failed + 1 :]]
    return Feedback(number, tuple(remarks), "The goal is not reached: red_disc is not in tray.")


def told(*trace: Feedback) -> Context:
    return replace(CONTEXT, trace=trace)


actions = st.one_of(
    st.builds(pick, st.sampled_from(NAMES), st.floats(-3.14, 3.14)),
    st.builds(place, st.sampled_from(NAMES), st.floats(0, 1.2), st.floats(0, 0.8)),
    st.builds(push, st.sampled_from(NAMES), st.floats(0, 1.2), st.floats(0, 0.8)),
)
traces = traces_of(actions)


@some
@given(traces, seeds)
def test_whatever_the_trace_it_writes_a_plan_of_valid_actions_and_the_same_again(trace, seed):
    assert plan(told(*trace), seed) == plan(told(*trace), seed)


PICKS = (pick("red_disc", 0.0),) * 3


@some
@given(traces, seeds, st.sampled_from(DOMAIN.settings))
@example((feedback(1, PICKS, 2, None),), 0, "open")
def test_a_given_sequence_is_kept(trace, seed, setting):
    instance = DOMAIN.instance(setting, 0)
    context = replace(context_of(instance), trace=trace, skeleton=DOMAIN.skeleton(instance))
    assert [(a.name, a.objects) for a in plan(context, seed)] == [(s.name, s.objects) for s in context.skeleton]


def test_the_first_plan_moves_what_has_a_goal_and_nothing_else():
    first = plan(CONTEXT)
    assert [(a.name, a.objects) for a in first] == [("pick", ("red_disc",)), ("place", ("red_disc",))]
    assert 0.95 < first[1].params["x"] < 1.15
    assert abs(first[0].params["angle"]) == pytest.approx(3.14)


def test_the_prose_of_the_task_does_not_matter():
    assert plan(replace(CONTEXT, task="")) == plan(CONTEXT)


def test_what_is_too_large_is_pushed():
    context = context_of(problem(box("red_box", 0.3, 0.4, (0.18, 0.1)), box("grey_box", 0.6, 0.7)))
    assert [a.name for a in plan(context)] == ["push"]


def test_what_lies_where_it_belongs_is_left_alone():
    state = tuple(
        Entity(e.name, {**e.properties, "position": (1.05, 0.4)}) if e.name == "red_disc" else e for e in CONTEXT.state
    )
    assert plan(replace(CONTEXT, state=state)) == ()


def test_where_two_things_change_places_one_of_them_makes_room():
    first = plan(context_of(DOMAIN.instance("swap", 0)))
    assert [a.name for a in first] == ["pick", "place"] * 3
    assert first[0].objects == first[4].objects != first[2].objects


@pytest.mark.parametrize("kind", [BLOCKED, None])
def test_it_keeps_what_worked_and_chooses_another_spot(kind):
    first = plan(CONTEXT)
    again = plan(told(feedback(1, first, 1, kind)), 1)
    assert again[0] == first[0]
    assert again[1].name == "place"
    assert again[1].params != first[1].params


@pytest.mark.parametrize("kind", [CUT_OFF, FailureKind.NO_PATH])
def test_where_there_is_no_way_what_nobody_asked_for_is_moved_first(kind):
    first = plan(CONTEXT)
    again = plan(told(feedback(1, first, 1, kind)))
    assert [(a.name, a.objects[0]) for a in again] == [
        ("pick", "grey_box"),
        ("place", "grey_box"),
        ("pick", "red_disc"),
        ("place", "red_disc"),
    ]
    aside = again[1].params
    assert np.hypot(aside["x"] - 0.6, aside["y"] - 0.4) > 0.1


def test_a_side_that_failed_is_not_taken_again():
    first = plan(CONTEXT)
    again = plan(told(feedback(1, first, 0, BLOCKED)))
    assert abs(again[0].params["angle"] - first[0].params["angle"]) > 1


def test_after_many_failures_with_one_object_all_is_done_anew():
    context = context_of(DOMAIN.instance("packing", 0))
    first = plan(context)
    stuck = tuple(feedback(number, first, 7, BLOCKED) for number in range(1, 6))
    again = plan(replace(context, trace=stuck), 3)
    assert again[1] != first[1]
    assert plan(replace(context, trace=stuck[:2]), 3)[:7] == first[:7]


@pytest.mark.parametrize("level", ["categorized", "binary", "none"])
def test_it_works_with_every_feedback_level(solve, level):
    result, _, _ = solve(setting="clutter", seed=0, feedback=level, max_llm_calls=4)
    for attempt in result.attempts:
        assert attempt.unreadable is None
        assert all(isinstance(action, Action) for action in attempt.proposal.actions)


def test_it_works_where_the_sequence_is_given(solve):
    result, _, _ = solve(setting="clutter", seed=0, strategy="sample-params")
    assert result.solved
