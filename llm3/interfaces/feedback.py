"""The words in which a model hears of its failures."""

from __future__ import annotations

from abc import ABC, abstractmethod

from llm3.types import Attempt, Feedback


class FeedbackSynthesizer(ABC):
    """Turns what happened into what the model is told."""

    @abstractmethod
    def synthesize(self, attempt: Attempt) -> Feedback | None:
        """The feedback on an attempt that did not reach the goal, or None to say nothing.

        Notes of outcomes (what slid, what toppled) belong into every feedback, whatever its level.
        """
