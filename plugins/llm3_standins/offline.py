"""The default backend: the domain's own rules, or random sampling where it has none."""

from __future__ import annotations

import numpy as np

from llm3 import BackendSettings, LLMBackend
from llm3.errors import UsageError
from llm3.interfaces import StandIn
from llm3.types import Completion, Request
from llm3_standins.sampler import RandomBackend


def offline(settings: BackendSettings) -> LLMBackend:
    """The domain's stand-in, or the random sampler with a notice that says so.

    Raises:
        UsageError: The domain offers nothing for either.
    """
    if settings.stand_in is None and not settings.skeleton and not settings.pieces:
        raise UsageError(
            f"domain {settings.domain!r} has no rule-based stand-in and no skeleton to draw parameters for: "
            "give --model NAME or --llm scripted:FILE."
        )
    if settings.stand_in is None:
        return RandomBackend(
            settings,
            f"No language model is used: domain {settings.domain!r} has no rule-based stand-in, "
            "so the backend 'random' draws the parameters.",
        )
    return OfflineBackend(settings.stand_in, settings.domain)


class OfflineBackend(LLMBackend):
    """Answers by a domain's rules, which know what the prompt tells and no more."""

    def __init__(self, stand_in: StandIn, domain: str) -> None:
        """Wrap a domain's stand-in."""
        self._stand_in, self._domain = stand_in, domain

    @property
    def is_language_model(self) -> bool:
        """It is none."""
        return False

    @property
    def notice(self) -> str:
        """Says so."""
        return f"No language model is used: the rule-based stand-in of domain {self._domain!r} writes the replies."

    def complete(self, request: Request) -> Completion:
        """The stand-in's reply, as text: it passes through the same parser as a model's."""
        return Completion(self._stand_in(request.context, np.random.default_rng(request.seed)))
