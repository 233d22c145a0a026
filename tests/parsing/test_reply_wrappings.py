"""What may stand around a plan, and what is mended."""

import json
import re

import pytest
from parsing_world import PLAN, PLAN_TEXTS, parse, reply

from llm3.parsing import parse_reply
from llm3.types import Action, ActionSchema, Proposal

ANSWER = reply(*PLAN_TEXTS)
DRAFT = reply("pick(['blue_box'], {})", reasoning="a first idea")
INDENTED = json.dumps(json.loads(ANSWER), indent=4)


@pytest.mark.parametrize(
    "text",
    [
        ANSWER,
        f"\ufeff{ANSWER}\n",
        INDENTED,
        f"```json\n{INDENTED}\n```",
        f"```\n{ANSWER}\n```",
        f"~~~JSON5\n{ANSWER}\n~~~",
        f"Here is {{x: the plan}} that doesn't fail [see above]:\n```json\n{ANSWER}\n```\nIt's {{short}}.",
        f"Let's see {{'x: 1}} and [\"\n{ANSWER}",
        f"The boxes [0.39, -0.2] and ['red_box'] are near, {{}} and [] are empty. {ANSWER} Done :-}}",
        f"```json\n{DRAFT}\n```\nNo, it slides. Better:\n```json\n{ANSWER}\n```",
        f"{DRAFT}{ANSWER}",
        f"{ANSWER}\nwith ['pick(x)'] left out",
        f"{ANSWER}\n" + '{"Full Plan": "as above"}',
        f"<think>maybe {DRAFT}</think>{ANSWER}",
        f"maybe {DRAFT}</THINK>\n{ANSWER}",
        f"<thinking>{{ [ '</thinking>{ANSWER}",
        f"[{ANSWER}]",
        f'{{"answer": {{"final": {ANSWER}}}}}',
        ANSWER.replace("Full Plan", "full_plan").replace("Reasoning", "REASONING"),
        ANSWER.replace("Full Plan", "FullPlan").replace("Reasoning", "reason"),
        ANSWER.replace("Full Plan", "plan"),
        ANSWER.replace("Full Plan", "Actions"),
        ANSWER.replace("Full Plan", "full plans"),
        ANSWER[:-1] + ', "confidence": 0.9, "notes": null, "plan": "see above"}',
    ],
)
def test_wrapping_changes_nothing(text):
    assert parse(text) == Proposal(PLAN, "because")


@pytest.mark.parametrize(
    ("text", "repairs"),
    [
        (str(json.loads(ANSWER)), ("read text in single quotes",)),
        (re.sub('"([^"]*)"', r"“\1”", ANSWER), ("read text in typographic quotes",)),
        (INDENTED.replace("\n    ]", ",\n    ],"), ("ignored a trailing comma",)),
        (INDENTED.replace("{\n", "{ // first\n", 1), ("ignored a comment",)),
        (INDENTED.replace("{\n", "{ # first\n", 1), ("ignored a comment",)),
        (INDENTED.replace("{\n", "{ /* first: [ */\n", 1), ("ignored a comment",)),
        (ANSWER[:-1] + ', "sure": True}', ("read a Python literal (True, False or None)",)),
        (ANSWER.replace('"Reasoning"', "Reasoning"), ("read text without quotes",)),
        (
            f'{{"Reasoning": "because", "Full Plan": [{", ".join(PLAN_TEXTS)}]}}',
            ("read text without quotes", "read text in single quotes"),
        ),
    ],
)
def test_liberties_with_json_are_taken_and_named(text, repairs):
    assert parse(text) == Proposal(PLAN, "because", repairs)


def test_a_line_break_in_text_is_read():
    assert parse('{"Reasoning": "one\ntwo", "Full Plan": []}') == Proposal(
        (), "one\ntwo", ("read text with a line break in it",)
    )


@pytest.mark.parametrize(
    "text",
    [
        json.dumps(PLAN_TEXTS),
        f"My plan: {json.dumps(PLAN_TEXTS)}.",
        json.dumps({"steps": PLAN_TEXTS}),
        f'{{"Reasoning": "the "best" one", "Full Plan": {json.dumps(PLAN_TEXTS)}}}',
        f'"Full Plan": {json.dumps(PLAN_TEXTS)}',
    ],
)
def test_a_list_of_actions_will_do(text):
    repairs = ('took a list of actions that is not in the reply\'s "Full Plan"',)
    assert parse(text) == Proposal(PLAN, "", repairs)


def test_quotes_inside_quotes():
    texts = ", ".join('"' + text.replace("'", '"') + '"' for text in PLAN_TEXTS)
    proposal = parse(f'{{"Reasoning": "because", "Full Plan": [{texts}]}}')
    assert (proposal.actions, proposal.reasoning) == (PLAN, "because")
    assert proposal.repairs == (
        "took away the quotes around actions, as there are quotes inside",
        "read text without quotes",
    )


@pytest.mark.parametrize("text", [ANSWER[:-2], ANSWER[:-1], ANSWER.replace(", ", " ", 1)[:-2] + "\n```\nThere."])
def test_damaged_json_is_mended_and_every_repair_is_named(text):
    proposal = parse(text)
    assert proposal.actions == PLAN
    assert proposal.repairs
    assert all(repair.startswith(("json-repair: ", "took a list of actions")) for repair in proposal.repairs)


def test_a_reply_that_breaks_off_keeps_its_complete_actions_and_rejects_the_last():
    proposal = parse(ANSWER[: ANSWER.index("-0.02")])
    assert proposal.actions[0] == PLAN[0]
    assert not any(isinstance(item, Action) for item in proposal.actions[1:])
    assert len(proposal.actions) == 2


def test_long_damaged_text_is_not_mended():
    assert isinstance(parse(reply(*PLAN_TEXTS, reasoning="x" * 7_000)[:-2] + " "), Proposal)
    damaged = reply({"action": "wait"}, reasoning="x" * 9_000)[:-3]
    assert not isinstance(parse(damaged), Proposal)


def test_values_are_never_changed_by_mending():
    damaged = '{"Full Plan": [{"action": "stack", "objects": ["red_box" "blue_box"], "params": {"ratio": 1/2}}'
    (item,) = parse(damaged).actions
    assert item.failure.detail == "ratio = '1/2' is no plain number: it must be one from 0 to 1"


def test_an_empty_plan_is_a_plan():
    assert parse(reply()) == Proposal((), "because")


def test_reasoning_that_is_no_text_is_kept_as_it_was_written():
    assert parse('{"Reasoning": {"(i)": "it slid"}, "Full Plan": []}').reasoning == '{"(i)": "it slid"}'


def test_two_hundred_actions_are_read():
    proposal = parse(reply(*["wait()"] * 200))
    assert proposal.actions == (PLAN[3],) * 200


def test_a_world_without_objects():
    assert parse_reply(reply("wait()"), (ActionSchema("wait"),), ()).actions == (PLAN[3],)
