"""What each feedback level tells of an attempt."""

from __future__ import annotations

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from llm3.interfaces import FeedbackSynthesizer
from llm3.types import (
    Action,
    Attempt,
    Contact,
    Failure,
    FailureKind,
    Feedback,
    GoalStatus,
    Outcome,
    Proposal,
    Rejected,
    Remark,
)
from llm3_words import plugin
from llm3_words.synthesizers import Binary, Categorized, Silent

PICK = Action("pick", ("red_box",))
PLACE = Action("place", ("red_box",), {"x": 0.5, "y": 0.0})
PICK_NEXT = Action("pick", ("blue_box",))
UNMET = GoalStatus(False, ("red_box is not in the basket.", "blue_box is not in the basket"))
SUMMARY = "The goal is not reached: red_box is not in the basket; blue_box is not in the basket."
COLLISION = Failure(
    FailureKind.GOAL_IN_COLLISION, "Try elsewhere.", ("tan_box",), (Contact("gripper", "tan_box", 0.003),)
)
FEASIBLE = "The goal configuration is collision-free and reachable."


def attempt(*outcomes: Outcome, planned: tuple[Action | Rejected, ...] = (PICK, PLACE, PICK_NEXT)) -> Attempt:
    return Attempt(3, UNMET, Proposal(planned), outcomes=outcomes)


COLLIDED = attempt(Outcome(PICK, notes=("tan_box slid 12 mm",)), Outcome(PLACE, COLLISION))


def test_categorized_tells_why() -> None:
    assert Categorized().synthesize(COLLIDED) == Feedback(
        3,
        (
            Remark("pick(['red_box'], {})", "feasible", f"{FEASIBLE} tan_box slid 12 mm."),
            Remark(
                "place(['red_box'], {'x': 0.5, 'y': 0.0})",
                "failed",
                "The goal configuration is in collision with tan_box (touched by the gripper). Try elsewhere.",
                FailureKind.GOAL_IN_COLLISION,
            ),
            Remark("pick(['blue_box'], {})", "not tried"),
        ),
        SUMMARY,
    )


def test_binary_tells_which_action_failed_and_no_more() -> None:
    assert Binary().synthesize(COLLIDED) == Feedback(
        3,
        (
            Remark("pick(['red_box'], {})", "feasible", "tan_box slid 12 mm."),
            Remark("place(['red_box'], {'x': 0.5, 'y': 0.0})", "failed"),
            Remark("pick(['blue_box'], {})", "not tried"),
        ),
        SUMMARY,
    )


def test_none_tells_the_notes_alone() -> None:
    assert Silent().synthesize(COLLIDED) == Feedback(3, summary="tan_box slid 12 mm.")


def test_none_tells_nothing_where_there_are_no_notes() -> None:
    assert Silent().synthesize(attempt(Outcome(PICK), Outcome(PLACE, COLLISION))) is None


@pytest.mark.parametrize("level", [Categorized(), Binary()])
def test_what_the_model_wrote_wrongly_is_told(level: FeedbackSynthesizer) -> None:
    rejected = Rejected("place(red)", Failure(FailureKind.INVALID_ACTION, "place needs x: it is missing."))
    feedback = level.synthesize(attempt(Outcome(rejected, rejected.failure), planned=(rejected, PICK)))
    assert feedback is not None
    assert feedback.remarks == (
        Remark("place(red)", "failed", "place needs x: it is missing.", FailureKind.INVALID_ACTION),
        Remark("pick(['red_box'], {})", "not tried"),
    )


@pytest.mark.parametrize("level", [Categorized(), Binary()])
def test_a_precondition_is_told(level: FeedbackSynthesizer) -> None:
    failure = Failure(FailureKind.PRECONDITION, "red_box is not held.")
    feedback = level.synthesize(attempt(Outcome(PLACE, failure), planned=(PLACE,)))
    assert feedback is not None
    assert feedback.remarks == (Remark(str(PLACE), "failed", "red_box is not held.", FailureKind.PRECONDITION),)


UNREADABLE = Attempt(1, UNMET, unreadable=Failure(FailureKind.UNREADABLE_REPLY, "The reply holds no JSON."))


@pytest.mark.parametrize("level", [Categorized(), Binary()])
def test_an_unreadable_reply_is_told(level: FeedbackSynthesizer) -> None:
    assert level.synthesize(UNREADABLE) == Feedback(1, summary="The reply holds no JSON.")


def test_none_does_not_tell_of_an_unreadable_reply() -> None:
    assert Silent().synthesize(UNREADABLE) is None


@pytest.mark.parametrize("level", [Categorized(), Binary()])
def test_a_plan_without_actions_has_the_summary_alone(level: FeedbackSynthesizer) -> None:
    assert level.synthesize(attempt(planned=())) == Feedback(3, summary=SUMMARY)


@pytest.mark.parametrize("level", [Categorized(), Binary()])
def test_a_reached_goal_is_not_called_unmet(level: FeedbackSynthesizer) -> None:
    reached = Attempt(2, GoalStatus(True), Proposal((PLACE,)), outcomes=(Outcome(PLACE, COLLISION),))
    feedback = level.synthesize(reached)
    assert feedback is not None
    assert feedback.summary == ""


names = st.sampled_from(["top_shelf", "low_shelf", "table", "wall"])
motion_failures = st.builds(
    Failure,
    kind=st.sampled_from([kind for kind in FailureKind if kind.is_motion]),
    detail=st.one_of(st.just(""), names.map("It is beyond {}.".format)),
    objects=st.lists(names, max_size=3).map(tuple),
    contacts=st.lists(st.builds(Contact, st.just("arm"), names), max_size=3).map(tuple),
)
outcome_lists = st.tuples(st.integers(0, 3), st.one_of(st.none(), motion_failures)).map(
    lambda drawn: [Outcome(PICK) for _ in range(drawn[0])] + ([Outcome(PLACE, drawn[1])] if drawn[1] else [])
)


@given(motion_failures)
@settings(deadline=None)
def test_binary_keeps_the_reason_of_a_motion_failure_to_itself(failure: Failure) -> None:
    why, other = (Binary().synthesize(attempt(Outcome(PLACE, f))) for f in (failure, Failure(FailureKind.UNREACHABLE)))
    assert why == other
    assert not any(name in repr(why) for name in failure.objects)


@given(outcome_lists, st.integers(0, 3))
@settings(deadline=None)
@pytest.mark.parametrize("level", [Categorized(), Binary()])
def test_there_is_one_remark_for_each_action(level: FeedbackSynthesizer, outcomes: list[Outcome], more: int) -> None:
    planned = (*(outcome.action for outcome in outcomes), *[PICK_NEXT] * more)
    feedback = level.synthesize(attempt(*outcomes, planned=planned))
    assert feedback is not None
    assert [remark.action for remark in feedback.remarks] == [str(action) for action in planned]
    verdicts = ["failed" if outcome.failure else "feasible" for outcome in outcomes] + ["not tried"] * more
    assert [remark.verdict for remark in feedback.remarks] == verdicts


@given(st.lists(st.sampled_from(["red_box slid 5 mm", "tan_box toppled."]), max_size=3).map(tuple))
@settings(deadline=None)
@pytest.mark.parametrize("level", [Categorized(), Binary(), Silent()])
@pytest.mark.parametrize("failure", [None, COLLISION])
def test_notes_are_told_at_every_level(
    level: FeedbackSynthesizer, failure: Failure | None, notes: tuple[str, ...]
) -> None:
    feedback = level.synthesize(attempt(Outcome(PLACE, failure, notes), planned=(PLACE,)))
    assert all(note.rstrip(".") in repr(feedback) for note in notes)


def test_the_plugin_offers_the_three_levels() -> None:
    levels = {name: type(factory()) for name, factory in plugin.llm3_feedback().items()}
    assert levels == {"categorized": Categorized, "binary": Binary, "none": Silent}


def test_an_action_without_motion_is_not_called_reachable():
    rested = Outcome(PICK, moved=False)
    waited = attempt(rested, planned=(PICK,))
    assert Categorized().synthesize(waited).remarks[0].text == "It is possible without any motion."
    assert Binary().synthesize(waited).remarks[0].text == ""
