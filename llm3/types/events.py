"""What a run tells whoever watches it, as it happens."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass

from llm3.types.attempts import Attempt, Outcome, Proposal
from llm3.types.dialogue import Completion, Feedback, Message
from llm3.types.failures import Failure
from llm3.types.results import PlannedAction, Result
from llm3.types.state import State
from llm3.types.stats import Stats


@dataclass(frozen=True)
class RunStarted:
    """The world was reset."""

    state: State


@dataclass(frozen=True)
class PromptSent:
    """A prompt is on its way to the model."""

    attempt: int
    messages: tuple[Message, ...]


@dataclass(frozen=True)
class ReplyReceived:
    """The model answered."""

    attempt: int
    completion: Completion


@dataclass(frozen=True)
class CallFailed:
    """No answer came, and the run ends."""

    attempt: int
    error: str
    """The sentence for the user."""
    stats: Stats
    """What the call cost all the same."""


@dataclass(frozen=True)
class ReplyRead:
    """The reply was parsed, into a plan or into the reason why there is none; in a search, a plan is tried next."""

    attempt: int
    proposal: Proposal | Failure


@dataclass(frozen=True)
class ActionTried:
    """One action of the plan was tried."""

    attempt: int
    index: int
    """Its place in the plan, from 0."""
    before: State
    """Where it begins."""
    outcome: Outcome
    step: PlannedAction | None = None
    """How it is done and where it leads, if it is feasible."""


@dataclass(frozen=True)
class AttemptEnded:
    """An attempt is over."""

    attempt: Attempt
    feedback: Feedback | None
    """What the model will be told; None where the feedback level tells nothing."""
    stats: Stats
    """All that the run has spent so far."""


@dataclass(frozen=True)
class RunEnded:
    """The run is over."""

    result: Result


RunEvent = RunStarted | PromptSent | ReplyReceived | CallFailed | ReplyRead | ActionTried | AttemptEnded | RunEnded
"""Anything that an observer is told."""
Observer = Callable[[RunEvent], None]
"""Is called with each event, in order."""


def nobody(_: RunEvent) -> None:
    """The observer that does not look."""
