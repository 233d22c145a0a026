"""A feedback level at work on attempts that fail in every way."""

from __future__ import annotations

from collections.abc import Iterator

from llm3.interfaces import FeedbackSynthesizer
from llm3.testing.conformance.attempts import Told, attempts
from llm3.types import Failure, FailureKind, Feedback, Remark

BETWEEN = " .;,"
"""What stands between two parts of a text."""


class Telling:
    """A feedback level at work."""

    def __init__(self, synthesizer: FeedbackSynthesizer) -> None:
        self.synthesizer, self.told = synthesizer, attempts()

    def answer(self, told: Told) -> Feedback | None:
        """What it tells of an attempt; None if that is nothing, or nothing that can be read."""
        feedback = self.synthesizer.synthesize(told.attempt)
        well_formed = isinstance(feedback, Feedback) and all(isinstance(text, str) for text in texts_of(feedback))
        return feedback if well_formed else None

    def answers(self) -> Iterator[tuple[Told, Feedback]]:
        """What it tells, where it tells anything."""
        for told in self.told:
            feedback = self.answer(told)
            if feedback is not None:
                yield told, feedback

    def failures(self) -> Iterator[tuple[Told, Failure, Remark, str]]:
        """What it tells of actions that failed: the failure, the remark, and what the remark says of the reason.

        That is its text without the notes; nothing where it has the same words for a motion of whatever kind.
        """
        found = list(self._failures())
        bare = {failure.kind: text for _, failure, _, text in found if failure == Failure(failure.kind)}
        verdicts = {text for kind, text in bare.items() if kind.is_motion}
        for told, failure, remark, text in found:
            yield told, failure, remark, "" if verdicts == {text} else text

    def _failures(self) -> Iterator[tuple[Told, Failure, Remark, str]]:
        for told, feedback in self.answers():
            for remark, outcome in zip(feedback.remarks, told.attempt.outcomes, strict=False):
                if remark.verdict == "failed" and outcome.failure is not None:
                    text = remark.text.replace(str(outcome.action), "")
                    for note in outcome.notes:
                        text = text.replace(note, "")
                    yield told, outcome.failure, remark, text.strip(BETWEEN)

    def told_kinds(self) -> frozenset[FailureKind]:
        """The kinds of failure that its words tell apart from all others, without an object and a detail."""
        said = {
            failure.kind: text
            for _, failure, _, text in self.failures()
            if failure == Failure(failure.kind) or failure.kind is FailureKind.INVALID_ACTION
        }
        texts = list(said.values())
        return frozenset(kind for kind, text in said.items() if text and texts.count(text) == 1)

    def texts(self, told: Told) -> tuple[str, ...]:
        """The texts on an attempt, the summary first."""
        feedback = self.answer(told)
        return texts_of(feedback) if feedback else ()

    def summary(self, told: Told) -> str:
        """The summary of an attempt."""
        return next(iter(self.texts(told)), "")


def texts_of(feedback: Feedback) -> tuple[str, ...]:
    """All that a model reads, the verdicts aside."""
    return feedback.summary, *(remark.text for remark in feedback.remarks)
