"""The ways to write one action."""

import json
import sys

import pytest
from hypothesis import given
from hypothesis import strategies as st
from parsing_world import PLAN, read_one

from llm3.parsing import parse_reply
from llm3.types import Action, ActionSchema, Parameter

PICK, PLACE, STACK, WAIT = PLAN

numbers = st.floats(allow_nan=False, allow_infinity=False)
actions = st.builds(
    Action,
    st.sampled_from(["pick", "place_on", "été", "_", "A1"]),
    st.lists(st.text(), max_size=3).map(tuple),
    st.dictionaries(st.text(), numbers, max_size=3),
)


@given(actions)
def test_an_action_is_read_as_it_prints_itself(action):
    schema = ActionSchema(
        action.name,
        ("thing",) * len(action.objects),
        tuple(Parameter(name, -sys.float_info.max, sys.float_info.max) for name in action.params),
    )
    text = json.dumps({"Full Plan": [str(action)]})
    (item,) = parse_reply(text, (schema,), action.objects).actions
    assert item == action
    assert str(item) == str(action)  # to the last bit, the sign of zero included


@pytest.mark.parametrize(
    "text",
    [
        "pick(['red_box'], {})",
        'pick(["red_box"], {})',
        "pick(['red_box'])",
        "pick(('red_box',), {})",
        "pick('red_box')",
        'pick("red_box", {})',
        "pick(red_box)",
        "pick([red_box])",
        "pick([‘red_box’], {})",
        "pick(['red_box'], None)",
        "pick(objects=['red_box'], params={})",
        "pick(object='red_box')",
        "pick(['red_box'], {},)",
        " pick ( [ 'red_box' , ] , { } ) ",
        "pick(['red_box'],\n     {})",
        "pick(['red_box'], {}),",
        "pick(['red_box'], {});",
        "pick(['red_box'], {})  # the red one is nearest",
        "1. pick(['red_box'], {})",
        "2) pick(['red_box'], {})",
        "Step 3: pick(['red_box'], {})",
        "- pick(['red_box'], {})",
        {"action": "pick", "objects": ["red_box"], "params": {}},
        {"name": "pick", "args": ["red_box"]},
        {"Action": "pick", "object": "red_box", "parameters": None},
        {"action_name": "pick", "arguments": "red_box"},
        {"action": "pick(['red_box'], {})"},
    ],
)
def test_forms_of_an_action_without_parameters(text):
    assert read_one(text) == PICK


@pytest.mark.parametrize(
    "text",
    [
        "place(['red_box'], {'x': 0.51, 'y': -0.02, 'theta': 0.0})",
        'place(["red_box"], {"theta": 0, "x": .51, "y": -2e-2})',
        "place(['red_box'], {x: 0.510, y: -0.02, theta: 0.})",
        "place(['red_box'], x=0.51, y=-0.02, theta=0)",
        "place(red_box, x=0.51, y=-0.02, theta=0)",
        "place(['red_box'], {'x': '0.51', 'y': \"-0.02\", 'theta': 0,})",
        "place(['red_box'], {'x': 0.51}, {'y': -0.02}, theta=0)",
        {"action": "place", "objects": ["red_box"], "params": {"x": 0.51, "y": -0.02, "theta": 0}},
        {"action": "place", "object": "red_box", "x": 0.51, "y": "-0.02", "theta": 0},
        {"name": "place", "object": "red_box", "args": {"x": 0.51, "y": -0.02, "theta": 0}},
    ],
)
def test_forms_of_an_action_with_parameters(text):
    assert read_one(text) == PLACE


@pytest.mark.parametrize(
    "text",
    [
        "stack(['red_box', 'blue_box'], {'ratio': 0.25})",
        "stack('red_box', 'blue_box', ratio=0.25)",
        "stack(['red_box'], ['blue_box'], {'ratio': 0.25})",
        {"action": "stack", "args": ["red_box", "blue_box"], "param": {"ratio": 0.25}},
    ],
)
def test_forms_of_an_action_with_two_objects(text):
    assert read_one(text) == STACK


@pytest.mark.parametrize("text", ["wait([], {})", "wait()", "wait", " wait ", {"action": "wait"}])
def test_forms_of_an_action_without_arguments(text):
    assert read_one(text) == WAIT


def test_a_backslash_before_a_sign_that_needs_none_is_left_out():
    assert read_one(r"pick(['red\_box'], {})") == PICK
