"""A feedback level at work on attempts that fail in every way."""

from __future__ import annotations

from collections.abc import Iterator

from llm3.interfaces import FeedbackSynthesizer
from llm3.testing.conformance.attempts import Told, attempts
from llm3.types import Feedback


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
