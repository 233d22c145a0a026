"""Every sentence that a model can read about its reply."""

import json

import pytest
from parsing_world import PLAN_TEXTS, complaint, fault, parse, read_one, reply

from llm3.parsing import parse_reply
from llm3.types import Action

FORM = """{"Reasoning": "...", "Full Plan": ["action(['object'], {'parameter': number})", ...]}"""
FORMS = (
    "pick(['box'], {}) or place(['box'], {'x': number, 'y': number, 'theta': number})"
    " or stack(['upper box', 'lower box'], {'ratio': number}) or wait([], {})"
)


@pytest.mark.parametrize("text", ["", '{"Reasoning": "', '{"Full Plan": ["wait()", "pi'])
def test_a_reply_that_was_cut_off_is_said_to_be(text):
    failure = parse_reply(text, (), (), cut_off=True)
    assert failure.detail == (
        "the reply was cut off at the length limit before its plan was complete: reason more briefly, and write one "
        f"JSON object of the form {FORM}"
    )


@pytest.mark.parametrize(
    ("text", "sentence"),
    [
        ("", f"the reply is empty: write one JSON object of the form {FORM}"),
        (" \n\t", f"the reply is empty: write one JSON object of the form {FORM}"),
        (
            "I cannot do that.",
            f"no complete plan can be read from the reply: write one JSON object of the form {FORM}",
        ),
        (
            '<think>{"Full Plan": ["wait()"]}',
            f"no complete plan can be read from the reply: write one JSON object of the form {FORM}",
        ),
        (
            '[{"name": "red_box", "position": [0, 0, 0]}]',
            f"no complete plan can be read from the reply: write one JSON object of the form {FORM}",
        ),
        (
            '{"Full Plan": "pick the red box"}',
            f"the plan is no list: write one JSON object of the form {FORM}",
        ),
        ('{"plan": {"1": "wait()"}}', f"the plan is no list: write one JSON object of the form {FORM}"),
        (" " * 200_001, "the reply has 200001 characters: at most 200000 are read"),
        (reply(*["wait()"] * 201), "the plan has 201 actions: at most 200 are allowed"),
        (
            '{"Full Plan": ' + "[" * 51 + "]" * 51 + "}",
            f"no complete plan can be read from the reply: write one JSON object of the form {FORM}",
        ),
    ],
)
def test_a_reply_that_cannot_be_read(text, sentence):
    assert complaint(text) == sentence


@pytest.mark.parametrize(
    ("item", "sentence"),
    [
        # no action at all
        ("", f"cannot read '' as one action: write {FORMS}"),
        ("pick the red box", f"cannot read 'pick the red box' as one action: write {FORMS}"),
        ("pick(['red_box'", f"cannot read 'pick(['red_box'' as one action: write {FORMS}"),
        ("wait() then wait()", f"cannot read 'wait() then wait()' as one action: write {FORMS}"),
        ("wait(action='wait')", f"cannot read 'wait(action='wait')' as one action: write {FORMS}"),
        (["wait"], f"cannot read '[\"wait\"]' as one action: write {FORMS}"),
        (7, f"cannot read '7' as one action: write {FORMS}"),
        (None, f"cannot read 'null' as one action: write {FORMS}"),
        (
            {"action": "wait", "Action": "pick"},
            f'cannot read \'{{"action": "wait", "Action": "pick"}}\' as one action: write {FORMS}',
        ),
        ({"objects": []}, f"cannot read '{{\"objects\": []}}' as one action: write {FORMS}"),
        # names
        ("grab(['red_box'], {})", "unknown action 'grab': the actions are pick, place, stack, wait"),
        ("Pick(['red_box'], {})", "unknown action 'Pick': the actions are pick, place, stack, wait"),
        ({"action": "grab"}, "unknown action 'grab': the actions are pick, place, stack, wait"),
        ("pick(['pink_box'], {})", "unknown object 'pink_box': the objects are red_box, blue_box"),
        ("pick([['red_box']], {})", "unknown object '['red_box']': the objects are red_box, blue_box"),
        # how many objects
        ("pick", "pick takes 1 object (box), not 0"),
        ("pick(['red_box', 'blue_box'], {})", "pick takes 1 object (box), not 2 (red_box, blue_box)"),
        (
            "stack(['red_box'], {'ratio': 0})",
            "stack takes 2 objects (upper box, lower box), not 1 (red_box)",
        ),
        ("wait(['red_box'], {})", "wait takes no objects, not 1 (red_box)"),
        # which parameters
        (
            "place(['red_box'], {'x': 0, 'y': 0})",
            "place lacks theta: give a number from -3.14 to 3.14 rad",
        ),
        ("stack(['red_box', 'blue_box'])", "stack lacks ratio: give a number from 0 to 1"),
        (
            "place(['red_box'], {'x': 0, 'y': 0, 'theta': 0, 'z': 1})",
            "place has no parameter 'z': it takes x, y, theta",
        ),
        ("pick(['red_box'], {'x': 0})", "pick has no parameter 'x': it takes none"),
        (
            "place(['red_box'], {'x': 0, 'y': 0, 'x': 0.5, 'theta': 0})",
            "place has x more than once: give one number from 0 to 1 m",
        ),
        # several faults
        (
            "place(['pink_box'], {'x': 2, 'y': 0, 'theta': NaN})",
            "unknown object 'pink_box': the objects are red_box, blue_box; "
            "x = 2 is out of range: it must be from 0 to 1 m; "
            "theta = NaN is no plain number: it must be one from -3.14 to 3.14 rad",
        ),
        (
            "place(['pink_box'], {})",
            "unknown object 'pink_box': the objects are red_box, blue_box; "
            "place lacks x: give a number from 0 to 1 m; "
            "place lacks y: give a number from -1 to 1 m; and 1 more",
        ),
    ],
)
def test_an_item_that_is_no_valid_action(item, sentence):
    assert fault(item) == sentence


NO_NUMBER = "theta = {} is no plain number: it must be one from -3.14 to 3.14 rad"
OUT_OF_RANGE = "theta = {} is out of range: it must be from -3.14 to 3.14 rad"


@pytest.mark.parametrize(
    ("value", "sentence"),
    [
        ("3.1400000000000006", OUT_OF_RANGE.format("3.1400000000000006")),
        ("-4", OUT_OF_RANGE.format("-4")),
        ("1e300", OUT_OF_RANGE.format("1e300")),
        ("'9.0'", OUT_OF_RANGE.format("9.0")),
        ("9" * 300, OUT_OF_RANGE.format("9" * 119 + "…")),
        ("1e999", NO_NUMBER.format("1e999")),
        ("1" * 5000, NO_NUMBER.format("1" * 119 + "…")),
        ("3.14/2", NO_NUMBER.format("3.14/2")),
        ("3.14 / 2", NO_NUMBER.format("3.14 / 2")),
        ("'3.14/2'", NO_NUMBER.format("'3.14/2'")),
        ("-math.pi", NO_NUMBER.format("-math.pi")),
        ("radians(90)", NO_NUMBER.format("radians(90)")),
        ("7//2", NO_NUMBER.format("7//2")),
        ("1_000", NO_NUMBER.format("1_000")),
        ("0x1", NO_NUMBER.format("0x1")),
        ("NaN", NO_NUMBER.format("NaN")),
        ("nan", NO_NUMBER.format("nan")),
        ("Infinity", NO_NUMBER.format("Infinity")),
        ("-inf", NO_NUMBER.format("-inf")),
        ("'nan'", NO_NUMBER.format("'nan'")),
        ("True", NO_NUMBER.format("True")),
        ("false", NO_NUMBER.format("false")),
        ("None", NO_NUMBER.format("None")),
        ("''", NO_NUMBER.format("''")),
        ("[0]", NO_NUMBER.format("[0]")),
        ("{'rad': 0}", NO_NUMBER.format("{'rad': 0}")),
    ],
)
def test_a_value_that_is_no_number_within_its_range(value, sentence):
    assert fault(f"place(['red_box'], {{'x': 0, 'y': 0, 'theta': {value}}})") == sentence


@pytest.mark.parametrize("value", [True, False, None, "nan", [0.5], {"m": 0.5}])
def test_a_json_value_that_is_no_number(value):
    item = {"action": "stack", "objects": ["red_box", "blue_box"], "params": {"ratio": value}}
    shown = f"'{value}'" if isinstance(value, str) else json.dumps(value)
    assert fault(item) == f"ratio = {shown} is no plain number: it must be one from 0 to 1"


@pytest.mark.parametrize("theta", ["-3.14", "3.14", "'3.14'", "+3.14", "314e-2", "-3.140"])
def test_a_bound_is_inside_its_range(theta):
    action = read_one(f"place(['red_box'], {{'x': 0, 'y': 1, 'theta': {theta}}})")
    assert isinstance(action, Action)
    assert action.params == {"x": 0.0, "y": 1.0, "theta": float(theta.strip("'"))}


def test_what_is_wrong_with_one_item_leaves_the_others_as_they_are():
    proposal = parse(reply(PLAN_TEXTS[0], "grab()", PLAN_TEXTS[3]))
    assert [str(item) for item in proposal.actions] == [PLAN_TEXTS[0], "grab()", PLAN_TEXTS[3]]


def test_text_of_the_model_is_shown_on_one_line_and_cut():
    rejected = read_one("first\n\x00second" + "x" * 1000)
    shown = "first\\n\\x00second" + "x" * 106 + "…"
    assert rejected.text == shown
    assert rejected.failure.detail == f"cannot read '{shown}' as one action: write {FORMS}"
