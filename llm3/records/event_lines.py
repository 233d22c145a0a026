"""The lines of events.jsonl: how each kind of event is written, and which fields it has when it is read."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

from llm3.jsonio import loads, unsorted
from llm3.types import (
    Action,
    ActionTried,
    AttemptEnded,
    Completion,
    Failure,
    Feedback,
    GoalStatus,
    Message,
    PlannedAction,
    Proposal,
    Rejected,
    RunEnded,
    RunEvent,
    State,
    Stats,
    Stop,
)

EVENTS_FORMAT = "llm3-events/1"


@dataclass(frozen=True)
class Line:
    """What every line has."""

    event: str
    time: float


@dataclass(frozen=True)
class RunStartedLine(Line):
    """The world was reset."""

    state: State


@dataclass(frozen=True)
class AttemptLine(Line):
    """What the lines of an attempt have."""

    attempt: int


@dataclass(frozen=True)
class PromptSentLine(AttemptLine):
    """A prompt is on its way."""

    messages: tuple[Message, ...]


@dataclass(frozen=True)
class ReplyReceivedLine(AttemptLine):
    """The model answered."""

    completion: Completion


@dataclass(frozen=True)
class CallFailedLine(AttemptLine):
    """No answer came."""

    error: str
    stats: Stats


@dataclass(frozen=True)
class ReplyReadLine(AttemptLine):
    """The reply was parsed."""

    proposal: Any
    """A Proposal or a Failure: see :func:`proposal_from`."""


@dataclass(frozen=True)
class OutcomeLine:
    """An Outcome, whose action is still to be read."""

    action: Any
    failure: Failure | None
    notes: tuple[str, ...]
    reused: bool
    moved: bool


@dataclass(frozen=True)
class ActionTriedLine(AttemptLine):
    """An action was tried."""

    index: int
    outcome: OutcomeLine
    before: State | None = None
    step: PlannedAction | None = None


@dataclass(frozen=True)
class AttemptEndedLine(AttemptLine):
    """An attempt is over; what it consists of stands in the lines before."""

    goal: GoalStatus
    feedback: Feedback | None
    stats: Stats


@dataclass(frozen=True)
class RunEndedLine(Line):
    """The run is over; what it consists of stands in the lines before."""

    solved: bool
    stop: Stop
    goal: GoalStatus
    stats: Stats


@dataclass(frozen=True)
class _ProposalLine:
    actions: tuple[Any, ...]
    reasoning: str
    repairs: tuple[str, ...]


def fields_of(event: RunEvent) -> dict[str, Any]:
    """The fields of an event, without what earlier lines have said already."""
    if isinstance(event, AttemptEnded):
        attempt = event.attempt
        return {"attempt": attempt.number, "goal": attempt.goal, "feedback": event.feedback, "stats": event.stats}
    if isinstance(event, ActionTried) and event.outcome.reused:
        return {"attempt": event.attempt, "index": event.index, "outcome": event.outcome}
    if isinstance(event, RunEnded):
        result = event.result
        return {"solved": result.solved, "stop": result.stop, "goal": result.goal, "stats": result.stats}
    return {name: getattr(event, name) for name in event.__dataclass_fields__}


def proposal_from(plain: Any, source: str) -> Proposal | Failure:
    """A proposal, or the failure in its place, which alone has a `kind`.

    Raises:
        InputError: It is neither.
    """
    if isinstance(plain, dict) and "kind" in plain:
        return loads(unsorted(plain), Failure, f"{source}, proposal")
    line = loads(unsorted(plain), _ProposalLine, f"{source}, proposal")
    return Proposal(tuple(action_from(item, source) for item in line.actions), line.reasoning, line.repairs)


def action_from(plain: Any, source: str) -> Action | Rejected:
    """An action, or what is no valid action in its place, which alone has a `text`.

    Raises:
        InputError: It is neither.
    """
    if isinstance(plain, dict) and "text" in plain:
        return loads(unsorted(plain), Rejected, f"{source}, action")
    return loads(unsorted(plain), Action, f"{source}, action")
