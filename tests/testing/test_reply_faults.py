"""Faults of a reply: each is what it is called, whatever the good reply was."""

import json

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from llm3.parsing import parse_reply
from llm3.testing import REPLY_FAULTS
from llm3.types import Action, ActionSchema, Completion, Failure, Parameter, Proposal, Rejected

SCHEMAS = (
    ActionSchema("go", (), (Parameter("x", -9, 9, "m"), Parameter("y", -9, 9, "m"))),
    ActionSchema("take", ("thing",)),
    ActionSchema("put", ("thing", "place"), (Parameter("turn", -4, 4, "rad"),)),
)
OBJECTS = ("coin", "red_box", "shelf")
BEFORE = Completion("what was said before")

numbers = st.floats(-4, 4).map(lambda x: round(x, 4))
actions = st.one_of(
    st.builds(lambda x, y: Action("go", (), {"x": x, "y": y}), numbers, numbers),
    st.builds(lambda thing: Action("take", (thing,)), st.sampled_from(OBJECTS)),
    st.builds(lambda thing, turn: Action("put", (thing, "shelf"), {"turn": turn}), st.sampled_from(OBJECTS), numbers),
)


def asked_for(plan, reasoning):
    return json.dumps({"Reasoning": reasoning, "Full Plan": [str(action) for action in plan]})


def bare(plan, _):
    return json.dumps([str(action) for action in plan])


def fenced(plan, reasoning):
    return f"{reasoning}\n```json\n{asked_for(plan, reasoning)}\n```\n"


plans = st.lists(actions, min_size=1, max_size=5)
good_replies = st.builds(
    lambda write, plan, reasoning: Completion(write(plan, reasoning)),
    st.sampled_from([asked_for, bare, fenced]),
    plans,
    st.sampled_from(["because", "take(['coin'], {}) has failed", 'the "wall" is in the way']),
)
seeds = st.integers(0, 2**32)
names = st.sampled_from(sorted(REPLY_FAULTS))


def spoilt(name, good, seed=0, before=BEFORE):
    return REPLY_FAULTS[name](good, before, np.random.default_rng(seed))


def read(completion):
    return parse_reply(completion.text, SCHEMAS, OBJECTS, cut_off=completion.cut_off)


@given(names, good_replies, seeds)
def test_the_same_generator_gives_the_same_fault(name, good, seed):
    assert spoilt(name, good, seed) == spoilt(name, good, seed)


@given(names, st.text() | good_replies.map(lambda good: good.text), seeds)
def test_any_reply_at_all_can_be_spoilt(name, text, seed):
    bad = spoilt(name, Completion(text), seed)
    assert isinstance(bad, Completion)
    assert isinstance(read(bad), Proposal | Failure)


@given(st.sampled_from(["invalid JSON", "truncated JSON"]), plans, st.sampled_from([asked_for, bare]), seeds)
def test_damaged_json_is_no_json(name, plan, write, seed):
    bad = spoilt(name, Completion(write(plan, 'with "quotes"')), seed)
    with pytest.raises(ValueError):
        json.loads(bad.text)
    assert bad.cut_off == (name == "truncated JSON")


@given(st.sampled_from(["prose only", "refusal", "empty", "endless plan"]), good_replies, seeds)
def test_a_reply_without_a_plan_is_unreadable(name, good, seed):
    assert isinstance(read(spoilt(name, good, seed)), Failure)


def test_a_refusal_says_that_it_is_one():
    assert spoilt("refusal", Completion("[]")).finish_reason == "refusal"


def test_the_endless_plan_has_a_hundred_thousand_actions():
    bad = spoilt("endless plan", Completion(asked_for([Action("take", ("red_box",)), Action("take", ("coin",))], "")))
    assert json.loads(bad.text)["Full Plan"] == ["take(['coin'], {})"] * 100_000


@given(st.sampled_from(["wrong number of objects", "unknown object", "NaN", "out of range"]), good_replies, seeds)
def test_one_action_of_the_plan_is_invalid_and_the_others_are_what_they_were(name, good, seed):
    bad, meant = read(spoilt(name, good, seed)), read(good)
    assert isinstance(bad, Proposal)
    assert bad.repairs == ()
    wrong = [n for n, action in enumerate(bad.actions) if isinstance(action, Rejected)]
    assert len(wrong) == 1
    kept = [action for n, action in enumerate(bad.actions) if n not in wrong]
    without = [action for n, action in enumerate(meant.actions) if n not in wrong]
    assert kept == without


@pytest.mark.parametrize(
    ("name", "plan", "sentence"),
    [
        ("wrong number of objects", ["take(['coin'], {})"], "take(['coin', 'coin'], {})"),
        ("unknown object", ["take(['coin'], {})"], "take(['no_such_object'], {})"),
        ("NaN", ["go([], {'x': 1.5, 'y': 2.0})"], "go([], {'x': NaN, 'y': 2.0})"),
        ("out of range", ["go([], {'x': -1e-05, 'y': 2.0})"], "go([], {'x': 1e9, 'y': 2.0})"),
    ],
)
def test_what_becomes_of_an_action(name, plan, sentence):
    assert json.loads(spoilt(name, Completion(json.dumps(plan))).text)["Full Plan"] == [sentence]


@given(good_replies, seeds)
def test_the_same_plan_again_is_what_was_said_before(good, seed):
    assert spoilt("same plan again", good, seed).text == BEFORE.text


def test_the_faults_cannot_be_changed():
    with pytest.raises(TypeError):
        REPLY_FAULTS["empty"] = REPLY_FAULTS["refusal"]
