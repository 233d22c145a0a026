"""A given action sequence: the model chooses the parameters only."""

import pytest
from hypothesis import given
from hypothesis import strategies as st
from parsing_world import PLAN, PLAN_TEXTS, parse, reply

from llm3.types import FailureKind, Rejected, Sketch

SKELETON = tuple(Sketch(action.name, action.objects) for action in PLAN)
GIVEN = "the action sequence is given, choose the parameters only"
OTHER = "pick(['blue_box'], {})"


def test_a_plan_that_keeps_to_the_sequence_is_read_as_it_is():
    assert parse(reply(*PLAN_TEXTS), SKELETON) == parse(reply(*PLAN_TEXTS))


@pytest.mark.parametrize(
    ("texts", "place", "text", "sentence"),
    [
        (
            [*PLAN_TEXTS[:1], OTHER, *PLAN_TEXTS[2:]],
            1,
            OTHER,
            f"action 2 must be place(['red_box'], ...), not pick(['blue_box'], ...): {GIVEN}",
        ),
        (
            [OTHER, *PLAN_TEXTS[1:]],
            0,
            OTHER,
            f"action 1 must be pick(['red_box'], ...), not pick(['blue_box'], ...): {GIVEN}",
        ),
        (
            PLAN_TEXTS[:2],
            2,
            "(end of the plan)",
            f"action 3 is missing, it must be stack(['red_box', 'blue_box'], ...): {GIVEN}",
        ),
        ([], 0, "(end of the plan)", f"action 1 is missing, it must be pick(['red_box'], ...): {GIVEN}"),
        (
            [*PLAN_TEXTS, OTHER],
            4,
            OTHER,
            f"action 5, {OTHER}, is one too many, the plan must have 4: {GIVEN}",
        ),
        (
            [*PLAN_TEXTS, "grab()"],
            4,
            "grab()",
            f"action 5, grab(), is one too many, the plan must have 4: {GIVEN}",
        ),
    ],
)
def test_the_first_departure_is_rejected(texts, place, text, sentence):
    item = parse(reply(*texts), SKELETON).actions[place]
    assert isinstance(item, Rejected)
    assert item.failure.kind is FailureKind.INVALID_ACTION
    assert (item.text, item.failure.detail) == (text, sentence)


def test_an_invalid_action_is_told_what_is_wrong_with_itself():
    texts = [PLAN_TEXTS[0], "place(['red_box'], {'x': 2, 'y': 0, 'theta': 0})", *PLAN_TEXTS[2:]]
    actions = parse(reply(*texts), SKELETON).actions
    assert actions[1].failure.detail == "x = 2 is out of range: it must be from 0 to 1 m"
    assert (actions[0], *actions[2:]) == (PLAN[0], *PLAN[2:])


@given(st.lists(st.sampled_from([*PLAN_TEXTS, OTHER, "grab()"]), max_size=6))
def test_no_plan_that_departs_is_free_of_rejected_items(texts):
    proposal = parse(reply(*texts), SKELETON)
    rejected = [item for item in proposal.actions if isinstance(item, Rejected)]
    assert bool(rejected) == (tuple(texts) != PLAN_TEXTS)
