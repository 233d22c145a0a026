"""What holds for every text."""

import json

from hypothesis import given
from hypothesis import strategies as st
from parsing_world import OBJECTS, PLAN, PLAN_TEXTS, SCHEMAS, parse, reply

from llm3.types import Action, Failure, FailureKind, Proposal, Rejected

ANSWERS = (
    reply(*PLAN_TEXTS),
    json.dumps(json.loads(reply(*PLAN_TEXTS)), indent=2),
    str(json.loads(reply(*PLAN_TEXTS))),
    reply({"action": "place", "objects": ["red_box"], "params": {"x": 0.5, "y": 0, "theta": 1}}, "wait()"),
    f"Well,\n```json\n{reply(*PLAN_TEXTS)}\n```\nvoilà",
)
PIECES = (
    *"{}[]()'\"`,:=\\/#*\n 1-.eé…“”‘’\x00\ud800\udfff",
    *('"Full Plan"', "//", "/*", "*/", "```", "<think>", "</think>", "pick(", "NaN", "None", "\\u", "\\ud83d"),
    *('{"plan": [', "'red_box'", "place(['red_box'], {'x': ", "1e999", "9" * 5000),
)

any_text = st.text(st.characters(categories=None)) | st.lists(st.sampled_from(PIECES)).map("".join)


@st.composite
def damaged_answers(draw):
    """Good replies, each with a few places cut out, doubled, or overwritten."""
    text = draw(st.sampled_from(ANSWERS))
    for _ in range(draw(st.integers(1, 4))):
        start, end = sorted((draw(st.integers(0, len(text))), draw(st.integers(0, len(text)))))
        new = draw(st.just("") | st.just(text[start:end] * 2) | any_text)
        text = text[:start] + new + text[end:]
    return text


def check(result):
    """Whatever comes back is a plan of valid actions and rejected items, or a reason why there is none."""
    json.dumps(repr(result), ensure_ascii=False).encode()
    if isinstance(result, Failure):
        assert result.kind is FailureKind.UNREADABLE_REPLY
        assert result.detail
        return
    assert isinstance(result, Proposal)
    result.reasoning.encode()
    schemas = {schema.name: schema for schema in SCHEMAS}
    for item in result.actions:
        if isinstance(item, Rejected):
            assert item.failure.kind is FailureKind.INVALID_ACTION
            assert item.failure.detail.isprintable()
            assert len(item.failure.detail) < 4_000
            assert len(item.text) < 1_300
            continue
        assert isinstance(item, Action)
        schema = schemas[item.name]
        assert set(item.objects) <= set(OBJECTS)
        assert len(item.objects) == len(schema.objects)
        assert list(item.params) == [parameter.name for parameter in schema.parameters]
        assert all(p.low <= item.params[p.name] <= p.high for p in schema.parameters)


@given(any_text)
def test_no_text_raises(text):
    check(parse(text))


@given(damaged_answers())
def test_no_damage_raises(text):
    check(parse(text))


@given(st.lists(any_text, min_size=1, max_size=5))
def test_no_item_raises(texts):
    check(parse(reply(*texts)))


@given(st.sampled_from(ANSWERS), any_text, any_text)
def test_no_chatter_raises(answer, before, after):
    check(parse(f"{before}\n{answer}\n{after}"))


json_values = st.recursive(
    st.none() | st.booleans() | st.integers() | st.floats(allow_nan=False, allow_infinity=False) | st.text(),
    lambda inner: st.lists(inner, max_size=4) | st.dictionaries(st.text(), inner, max_size=4),
    max_leaves=10,
)


@given(st.text(), json_values, st.booleans(), st.sampled_from([None, 2]))
def test_strict_json_is_read_as_json_and_needs_no_repair(reasoning, other, ascii_only, indent):
    answer = {"other": [other], "Reasoning": reasoning, "Full Plan": PLAN_TEXTS}
    text = json.dumps(answer, ensure_ascii=ascii_only, indent=indent)
    proposal = parse(text)
    assert proposal.actions == PLAN
    assert proposal.repairs == ()
    assert proposal.reasoning == reasoning


@given(st.text(st.characters(blacklist_characters="{}[]<", blacklist_categories=["Cs"])), st.sampled_from(ANSWERS[:4]))
def test_chatter_without_brackets_changes_nothing(chatter, answer):
    assert parse(chatter + answer + chatter) == parse(answer)
