"""What a server may hold a model to is what the parser reads."""

from __future__ import annotations

import json
import re

from hypothesis import given
from hypothesis import strategies as st
from parsing_world import OBJECTS, PLAN_TEXTS, SCHEMAS, parse, reply

from llm3.parsing import parse_reply, reply_schema
from llm3.types import ActionSchema, Proposal, Rejected, Sketch

SCHEMA = reply_schema(SCHEMAS, OBJECTS)
names = st.text(min_size=1, max_size=8)


def pattern(schema) -> str:
    return schema["properties"]["Full Plan"]["items"]["pattern"]


def test_the_schema_is_that_of_the_asked_for_form():
    assert json.loads(json.dumps(dict(SCHEMA))) == {
        "type": "object",
        "properties": {
            "Reasoning": {"type": "string"},
            "Full Plan": {"type": "array", "items": {"type": "string", "pattern": pattern(SCHEMA)}},
        },
        "required": ["Reasoning", "Full Plan"],
        "additionalProperties": False,
    }


def test_it_takes_the_actions_as_they_are_written():
    for text in PLAN_TEXTS:
        assert re.fullmatch(pattern(SCHEMA), text)


@given(st.from_regex(pattern(SCHEMA), fullmatch=True))
def test_whatever_it_takes_is_an_action_or_at_most_out_of_range(text):
    (item,) = parse(reply(text)).actions
    if isinstance(item, Rejected):
        assert "is out of range" in item.failure.detail


@given(st.lists(names, min_size=1, max_size=3, unique=True))
def test_names_with_any_characters_are_taken_literally(objects):
    schemas = (ActionSchema("pick", ("thing",)),)
    found = pattern(reply_schema(schemas, objects))
    for name in objects:
        text = f"pick([{name!r}], {{}})"
        assert re.fullmatch(found, text)
        read = parse_reply(reply(text), schemas, objects)
        assert isinstance(read, Proposal)
    assert not re.fullmatch(found, "pick(['somewhere else'], {})")


def test_a_given_sequence_allows_its_own_actions_only():
    skeleton = (Sketch("pick", ("red_box",)), Sketch("place", ("red_box",)))
    found = pattern(reply_schema(SCHEMAS, OBJECTS, skeleton))
    assert re.fullmatch(found, "pick(['red_box'], {})")
    assert re.fullmatch(found, "place(['red_box'], {'x': 0.5, 'y': -1, 'theta': 0.0})")
    assert not re.fullmatch(found, "pick(['blue_box'], {})")
    assert not re.fullmatch(found, "wait([], {})")


def test_without_any_action_every_text_will_do():
    assert reply_schema((), ())["properties"]["Full Plan"]["items"] == {"type": "string"}
