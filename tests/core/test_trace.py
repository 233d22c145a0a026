"""What the model is told of its past: the last k attempts, and never nothing of the motions."""

import pytest
from hypothesis import given
from hypothesis import strategies as st
from line_world import Mute, Plain, go, take

from llm3.trace import Trace, has_motions
from llm3.types import Attempt, Failure, FailureKind, GoalStatus, Outcome, Proposal, Rejected

UNMET = GoalStatus(False, ("the robot is not at the finish",))
NONSENSE = Rejected("dance()", Failure(FailureKind.INVALID_ACTION, "no such action"))

OUTCOMES = {
    "a feasible action": (Outcome(go(1)),),
    "a motion failure": (Outcome(go(1), Failure(FailureKind.NO_PATH)),),
    "a known result": (Outcome(go(1), Failure(FailureKind.UNREACHABLE), reused=True),),
    "a feasible action before an invalid one": (Outcome(go(1)), Outcome(NONSENSE, NONSENSE.failure)),
    "an invalid action": (Outcome(NONSENSE, NONSENSE.failure),),
    "a precondition": (Outcome(take("coin"), Failure(FailureKind.PRECONDITION)),),
    "an empty plan": (),
}
WITH_MOTIONS = tuple(OUTCOMES)[:4]


def attempt(number, what):
    if what == "unreadable":
        return Attempt(number, UNMET, unreadable=Failure(FailureKind.UNREADABLE_REPLY, "no plan"))
    outcomes = OUTCOMES[what]
    return Attempt(number, UNMET, Proposal(tuple(o.action for o in outcomes)), outcomes=outcomes)


def told(size, *history, words=Plain()):  # noqa: B008  # it holds nothing
    """The numbers of the attempts that a trace tells of after this history."""
    trace = Trace(size)
    for number, what in enumerate(history, 1):
        trace = trace.add(attempt(number, what), words.synthesize(attempt(number, what)))
    return [feedback.attempt for feedback in trace.entries]


histories = st.lists(st.sampled_from(["unreadable", *OUTCOMES]), max_size=8)


@pytest.mark.parametrize("what", OUTCOMES)
def test_which_attempts_have_motions(what):
    assert has_motions(attempt(1, what)) == (what in WITH_MOTIONS)


def test_an_unreadable_reply_has_none():
    assert not has_motions(attempt(1, "unreadable"))


@given(st.integers(1, 5), histories.map(lambda h: [what for what in h if what != "unreadable"]))
def test_of_readable_attempts_it_holds_the_last_k(size, history):
    assert told(size, *history) == list(range(1, len(history) + 1))[-size:]


@given(st.integers(1, 5), histories)
def test_the_newest_attempt_is_always_in_it_and_the_order_is_that_of_the_attempts(size, history):
    numbers = told(size, *history)
    assert numbers == sorted(set(numbers))
    assert numbers[-1:] == [len(history)] * bool(history)


@given(st.integers(1, 5), histories)
def test_it_holds_k_and_for_k_1_at_most_one_more(size, history):
    assert len(told(size, *history)) <= max(size, 2)
    assert len(told(size, *history)) >= min(size, len(history))


@given(st.integers(1, 5), histories, st.integers(1, 6))
def test_unreadable_replies_never_push_out_the_newest_attempt_with_motions(size, history, stumbles):
    before = told(size, *history)
    motions = [number for number in before if history[number - 1] in WITH_MOTIONS]
    after = told(size, *history, *["unreadable"] * stumbles)
    assert motions[-1:] == [number for number in after if number in motions][-1:]


@pytest.mark.parametrize(
    ("size", "numbers"), [(0, []), (1, [1, 4]), (2, [1, 4]), (3, [1, 3, 4]), (4, [1, 2, 3, 4]), (5, [1, 2, 3, 4])]
)
def test_three_stumbles_after_a_plan(size, numbers):
    assert told(size, "a motion failure", "unreadable", "unreadable", "unreadable") == numbers


def test_the_next_plan_takes_its_place_again():
    assert told(1, "a motion failure", "unreadable", "a feasible action") == [3]
    assert told(2, "a motion failure", "unreadable", "unreadable", "a feasible action") == [3, 4]
    assert told(2, "a motion failure", "an invalid action", "unreadable") == [1, 3]


@given(histories)
def test_size_0_tells_nothing_and_neither_does_a_level_that_says_nothing(history):
    assert told(0, *history) == []
    assert told(5, *history, words=Mute()) == []


def test_words_decide_nothing():
    class Terse(Plain):
        def synthesize(self, attempt):
            return type(super().synthesize(attempt))(attempt.number, summary="no")

    assert told(1, "a motion failure", "unreadable", words=Terse()) == [1, 2]
