"""Reads events.jsonl back, as the events that an observer was told."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass
from pathlib import Path

from llm3.errors import InputError
from llm3.jsonio import loads
from llm3.records.event_lines import (
    EVENTS_FORMAT,
    ActionTriedLine,
    AttemptEndedLine,
    AttemptLine,
    CallFailedLine,
    Line,
    PromptSentLine,
    ReplyReadLine,
    ReplyReceivedLine,
    RunEndedLine,
    RunStartedLine,
    action_from,
    proposal_from,
)
from llm3.records.json_lines import plain, read_lines
from llm3.records.plan import read_plan
from llm3.types import (
    Action,
    ActionTried,
    Attempt,
    AttemptEnded,
    CallFailed,
    Failure,
    Outcome,
    PlannedAction,
    PromptSent,
    Proposal,
    ReplyRead,
    ReplyReceived,
    Result,
    RunEnded,
    RunEvent,
    RunStarted,
    State,
)

_LINES: dict[str, tuple[type[Line], tuple[str, ...]]] = {
    "RunStarted": (RunStartedLine, ("",)),
    "PromptSent": (PromptSentLine, ("RunStarted", "AttemptEnded")),
    "ReplyReceived": (ReplyReceivedLine, ("PromptSent",)),
    "CallFailed": (CallFailedLine, ("PromptSent",)),
    "ReplyRead": (ReplyReadLine, ("ReplyReceived", "RunStarted", "AttemptEnded")),  # a search asks nobody
    "ActionTried": (ActionTriedLine, ("ReplyRead", "ActionTried")),
    "AttemptEnded": (AttemptEndedLine, ("ReplyRead", "ActionTried")),
    "RunEnded": (RunEndedLine, ("AttemptEnded", "CallFailed", "RunStarted")),  # the goal was reached at the start
}
"""Of each kind of event: the form of its line, and what may come before it."""


@dataclass(frozen=True)
class RecordedEvent:
    """An event of a record."""

    time: float
    """Seconds since the record began."""
    event: RunEvent


def read_events(folder: Path) -> Iterator[RecordedEvent]:
    """Everything that happened in a recorded run, in order; of a run that was cut off, all up to there.

    Args:
        folder: The run's folder.

    Raises:
        InputError: A line is not as documented, or stands where it cannot; the error names it.
    """
    reader, before = _Reader(folder), ""
    for source, text in read_lines(folder / "events.jsonl", EVENTS_FORMAT):
        kind = plain(text, source).get("event")
        if not isinstance(kind, str) or kind not in _LINES:
            raise InputError(f"{source}: unknown event {kind!r}. Known: {', '.join(_LINES)}.")
        form, after = _LINES[kind]
        if before not in after:
            raise InputError(f"{source}: {kind} cannot follow {before or 'the header'}")
        before, line = kind, loads(text, form, source)
        yield RecordedEvent(line.time, reader.event(line, source))


class _Reader:
    """Puts into each event what its line leaves out, since earlier lines have said it."""

    def __init__(self, folder: Path) -> None:
        self._folder = folder
        self._start = self._state = State()
        self._known: dict[tuple[State, Action], PlannedAction] = {}
        self._attempts: list[Attempt] = []
        self._reading: Proposal | Failure = Proposal(())
        self._outcomes: list[Outcome] = []
        self._plan: list[PlannedAction] = []

    def event(self, line: Line, source: str) -> RunEvent:
        """The event of a line."""
        if isinstance(line, RunStartedLine):
            self._start = line.state
            return RunStarted(line.state)
        if isinstance(line, RunEndedLine):
            return RunEnded(self._result(line))
        number = len(self._attempts) + 1
        assert isinstance(line, AttemptLine)  # noqa: S101  # all others are
        if line.attempt != number:
            raise InputError(f"{source}: the attempt is number {number}, not {line.attempt}")
        if isinstance(line, PromptSentLine):
            return PromptSent(number, line.messages)
        if isinstance(line, ReplyReceivedLine):
            return ReplyReceived(number, line.completion)
        if isinstance(line, CallFailedLine):
            return CallFailed(number, line.error, line.stats)
        if isinstance(line, ReplyReadLine):
            self._state, self._outcomes, self._plan = self._start, [], []
            self._reading = proposal_from(line.proposal, source)
            return ReplyRead(number, self._reading)
        if isinstance(line, ActionTriedLine):
            return self._tried(line, source)
        assert isinstance(line, AttemptEndedLine)  # noqa: S101  # the last kind that there is
        proposal = self._reading if isinstance(self._reading, Proposal) else None
        unreadable = self._reading if isinstance(self._reading, Failure) else None
        self._attempts.append(Attempt(number, line.goal, proposal, unreadable, tuple(self._outcomes)))
        return AttemptEnded(self._attempts[-1], line.feedback, line.stats)

    def _tried(self, line: ActionTriedLine, source: str) -> ActionTried:
        if line.index != len(self._outcomes):
            raise InputError(f"{source}: the index of the action is {len(self._outcomes)}, not {line.index}")
        written = line.outcome
        action = action_from(written.action, source)
        outcome = Outcome(action, written.failure, written.notes, written.reused, written.moved)
        before, step = line.before, line.step
        if written.reused and isinstance(action, Action):
            before, step = self._state, self._known.get((self._state, action))
        if before is None or (step is None) != (written.failure is not None):
            raise InputError(f"{source}: neither this line nor an earlier one tells how {action} was done")
        if step and isinstance(action, Action):
            self._known[before, action] = step
            self._plan.append(step)
            self._state = step.state
        self._outcomes.append(outcome)
        return ActionTried(line.attempt, line.index, before, outcome, step)

    def _result(self, line: RunEndedLine) -> Result:
        plan = tuple(self._plan) if line.solved else ()
        if line.solved and (self._folder / "plan.json").exists():
            plan = read_plan(self._folder).actions  # the same, with times
        attempts = tuple(self._attempts)
        return Result(line.solved, plan, line.goal, attempts, line.stats, self._start, line.stop)
