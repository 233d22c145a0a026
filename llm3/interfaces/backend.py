"""The language model, or what stands in for it."""

from __future__ import annotations

from abc import ABC, abstractmethod
from collections.abc import Callable, Mapping
from dataclasses import dataclass, field
from typing import Any

import numpy as np

from llm3.types import Completion, Context, FrozenDict, Message, Request, Sketch

Regions = Mapping[tuple[str, tuple[str, ...], str], tuple[float, float]]
"""Tighter ranges for random sampling, by (action name, its objects, parameter name)."""
StandIn = Callable[[Context, np.random.Generator], str]
"""Writes a reply from what a prompt tells: a rule-based stand-in for a model."""


@dataclass(frozen=True)
class BackendSettings:
    """What the user asked of a backend."""

    domain: str = ""
    """The domain's name, for messages."""
    argument: str | None = None
    """What follows the colon in ``--llm NAME:ARGUMENT``, such as a file."""
    model: str | None = None
    temperature: float | None = None
    """None: send no sampling parameter at all."""
    max_reply_tokens: int | None = None
    """What the model may write in one reply; None: send no limit unless the server demands one."""
    stand_in: StandIn | None = None
    """The domain's rule-based stand-in, where it has one."""
    skeleton: tuple[Sketch, ...] = ()
    """The domain's action sequence, where it has one."""
    pieces: tuple[tuple[Sketch, ...], ...] = ()
    """What the domain's solutions consist of, in an order that has to be found, where it tells."""
    regions: Regions = field(default_factory=FrozenDict)
    """The domain's sampling regions, where it has them."""
    run: str = ""
    """The problem and the method, such as ``boxpack/hard-small/0/backtrack/categorized``, for recordings."""


class LLMBackend(ABC):
    """Answers requests."""

    @property
    def is_language_model(self) -> bool:
        """Whether a language model stands behind it; runs without one say so."""
        return True

    @property
    def notice(self) -> str:
        """One line that the user should read before the run, or nothing."""
        return ""

    @abstractmethod
    def complete(self, request: Request) -> Completion:
        """Answer one request.

        Raises:
            BackendError: There is no answer to be had.
        """

    @property
    def recorded(self) -> Mapping[str, Any]:
        """What a recording says of its model: fields of a `RunConfig`, in place of what the user left out."""
        return FrozenDict()

    @property
    def last_words(self) -> str:
        """One line that the user should read after the run, or nothing."""
        return ""

    def examine(self) -> str:
        """Make one tiny call, and say in a line how it went, for ``llm3 doctor``.

        Raises:
            BackendError: There is no answer to be had; its sentence says what to change.
        """
        question = Message("user", 'Answer with this JSON object and nothing else: {"Reasoning": "", "Full Plan": []}')
        answer = self.complete(Request((question,), Context("", (), (), ())))
        return f"it answers with {len(answer.text)} characters"

    def close(self) -> None:
        """Let go of connections. Calling it twice does no harm."""
