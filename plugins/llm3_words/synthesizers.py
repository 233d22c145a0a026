"""Three feedback levels, from the one that tells most to the one that tells least.

Every level passes on the notes of outcomes: what physics did against the plan is true of the world, whatever the
model is told about motion planning.
"""

from __future__ import annotations

from abc import abstractmethod

from llm3.interfaces import FeedbackSynthesizer
from llm3.types import Attempt, Failure, Feedback, Outcome, Remark
from llm3_words.sentences import FEASIBLE, FEASIBLE_AT_REST, closed, sentence_of


class _Remarks(FeedbackSynthesizer):
    """One remark for each action of the plan, and the unmet goal or why the reply could not be read."""

    def synthesize(self, attempt: Attempt) -> Feedback:
        """The feedback on an attempt that did not reach the goal."""
        if attempt.unreadable:
            return Feedback(attempt.number, summary=sentence_of(attempt.unreadable))
        tried = tuple(self._remark(outcome) for outcome in attempt.outcomes)
        actions = attempt.proposal.actions if attempt.proposal else ()
        not_tried = tuple(Remark(str(action), "not tried") for action in actions[len(tried) :])
        return Feedback(attempt.number, tried + not_tried, _unmet(attempt))

    def _remark(self, outcome: Outcome) -> Remark:
        why = self._why(outcome.failure) if outcome.failure else self._feasible(outcome.moved)
        text = " ".join(closed(part) for part in (why, *outcome.notes) if part)
        kind = outcome.failure.kind if outcome.failure and why else None
        return Remark(str(outcome.action), "failed" if outcome.failure else "feasible", text, kind)

    @abstractmethod
    def _why(self, failure: Failure) -> str: ...

    @abstractmethod
    def _feasible(self, moved: bool) -> str: ...


class Categorized(_Remarks):
    """The paper's feedback: each action that was tried, with the category of its result and the objects to blame."""

    def _why(self, failure: Failure) -> str:
        return sentence_of(failure)

    def _feasible(self, moved: bool) -> str:
        return FEASIBLE if moved else FEASIBLE_AT_REST


class Binary(_Remarks):
    """Which action failed and what of the goal is unmet, but not why a motion failed (the paper's "no feedback").

    What is no matter of motion, such as an action that does not fit its schema, is told in full: it is about what
    the model wrote, and not about what a motion planner found out.
    """

    def _why(self, failure: Failure) -> str:
        return "" if failure.kind.is_motion else sentence_of(failure)

    def _feasible(self, moved: bool) -> str:  # noqa: ARG002  # it says nothing in either case
        return ""


class Silent(FeedbackSynthesizer):
    """Nothing about the attempt: not its plan, not its verdicts, not the unmet goal.

    What remains is the notes of its outcomes. Where there are any, they are the summary of a feedback without
    remarks; where there are none, there is no feedback.
    """

    def synthesize(self, attempt: Attempt) -> Feedback | None:
        """The notes of the attempt's outcomes, or None."""
        notes = [closed(note) for outcome in attempt.outcomes for note in outcome.notes]
        return Feedback(attempt.number, summary=" ".join(notes)) if notes else None


def _unmet(attempt: Attempt) -> str:
    parts = "; ".join(part.strip().rstrip(".") for part in attempt.goal.unmet)
    return f"The goal is not reached: {parts}." if parts else ""
