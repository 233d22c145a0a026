"""Every kind of failure has its sentence."""

from __future__ import annotations

import re

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from llm3.types import Contact, Failure, FailureKind
from llm3_words.sentences import closed, listed, sentence_of

BARE = {
    FailureKind.GOAL_IN_COLLISION: "The goal configuration is in collision.",
    FailureKind.START_IN_COLLISION: "The robot is in collision already where this action starts.",
    FailureKind.UNREACHABLE: (
        "The goal configuration has no inverse kinematics solution: it is out of the robot's reach."
    ),
    FailureKind.NO_PATH: (
        "The goal configuration is collision-free and reachable, but no collision-free path to it was found within "
        "the planning budget."
    ),
    FailureKind.PRECONDITION: "The action is not possible in the state that it starts from.",
    FailureKind.INVALID_ACTION: "This is not a valid action.",
    FailureKind.UNREADABLE_REPLY: "No plan could be read from the reply.",
}

names = st.sampled_from(["red_box", "basket", "table", "top_shelf", "wall"])
contacts = st.builds(
    Contact,
    part=st.sampled_from(["arm", "gripper", "held red_box"]),
    object=st.one_of(names, st.just("itself")),
    depth=st.floats(-0.01, 0.05),
)
failures = st.builds(
    Failure,
    kind=st.sampled_from(FailureKind),
    objects=st.lists(names, max_size=4).map(tuple),
    contacts=st.lists(contacts, max_size=4).map(tuple),
)


@pytest.mark.parametrize("kind", FailureKind)
def test_every_kind_has_a_sentence_of_its_own(kind: FailureKind) -> None:
    assert sentence_of(Failure(kind)) == BARE[kind]


@pytest.mark.parametrize(
    ("failure", "sentence"),
    [
        (
            Failure(FailureKind.GOAL_IN_COLLISION, objects=("red_box",)),
            "The goal configuration is in collision with red_box.",
        ),
        (
            Failure(
                FailureKind.GOAL_IN_COLLISION,
                objects=("red_box", "basket"),
                contacts=(
                    Contact("held blue_box", "red_box", 0.01),
                    Contact("gripper", "red_box", 0.004),
                    Contact("gripper", "red_box", 0.002),
                    Contact("arm", "basket", 0.001),
                ),
            ),
            "The goal configuration is in collision with red_box (touched by the held blue_box and the gripper) and "
            "basket (touched by the arm).",
        ),
        (
            Failure(FailureKind.GOAL_IN_COLLISION, objects=("a_box", "b_box", "c_box")),
            "The goal configuration is in collision with a_box, b_box and c_box.",
        ),
        (
            Failure(FailureKind.START_IN_COLLISION, contacts=(Contact("arm", "itself", 0.01),)),
            "The robot is in collision with the robot itself (touched by the arm) already where this action starts.",
        ),
        (
            Failure(FailureKind.UNREACHABLE, "The pose is 0.9 m from the base", ("red_box",)),
            "No motion leads to the goal configuration. Involved: red_box. The pose is 0.9 m from the base.",
        ),
        (
            Failure(FailureKind.NO_PATH, objects=("shelf",), measures={"gap": 0.3}),
            "The goal configuration is collision-free and reachable, but no collision-free path to it was found within "
            "the planning budget. Involved: shelf.",
        ),
        (
            Failure(FailureKind.PRECONDITION, "red_box is not held, so it cannot be placed.", ("red_box",)),
            "red_box is not held, so it cannot be placed.",
        ),
        (
            Failure(FailureKind.PRECONDITION, objects=("red_box",)),
            "The action is not possible in the state that it starts from. Involved: red_box.",
        ),
        (Failure(FailureKind.INVALID_ACTION, "x is missing"), "x is missing."),
        (Failure(FailureKind.UNREADABLE_REPLY, "The reply holds no JSON!"), "The reply holds no JSON!"),
    ],
)
def test_what_is_known_of_a_failure_is_told(failure: Failure, sentence: str) -> None:
    assert sentence_of(failure) == sentence


@given(failures)
@settings(deadline=None)
def test_every_object_that_is_to_blame_is_named(failure: Failure) -> None:
    sentence = sentence_of(failure)
    for name in (*failure.objects, *(contact.object for contact in failure.contacts)):
        assert re.search(rf"\b{name}\b", sentence)


@given(failures)
@settings(deadline=None)
def test_a_sentence_has_no_holes(failure: Failure) -> None:
    sentence = sentence_of(failure)
    assert sentence.endswith(".")
    assert sentence == " ".join(sentence.split())
    assert not re.search(r"[{}<>]|None|\(\)| [.,)]|\bthe the\b", sentence)


@given(failures)
@settings(deadline=None)
def test_figures_are_not_told(failure: Failure) -> None:
    assert not re.search(r"\d", sentence_of(failure))


@pytest.mark.parametrize(
    ("items", "text"), [([], ""), (["a"], "a"), (["a", "b"], "a and b"), (["a", "b", "c"], "a, b and c")]
)
def test_lists_read_as_prose(items: list[str], text: str) -> None:
    assert listed(items) == text


@pytest.mark.parametrize(("text", "whole"), [("it slid ", "it slid."), ("it slid.", "it slid."), ("why?", "why?")])
def test_sentences_are_closed(text: str, whole: str) -> None:
    assert closed(text) == whole


def test_what_can_be_reached_but_not_moved_through_is_not_called_out_of_reach() -> None:
    failure = Failure(FailureKind.UNREACHABLE, "The arm cannot come straight down on it.")
    assert sentence_of(failure) == (
        "No motion leads to the goal configuration. The arm cannot come straight down on it."
    )
