"""A recorded run as a story: turn by turn, what was asked, answered, tried and told."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass, replace
from pathlib import Path

from llm3.records import RunFile, read_events, read_run
from llm3.types import (
    Action,
    ActionTried,
    AttemptEnded,
    CallFailed,
    Completion,
    Failure,
    Message,
    PlannedAction,
    PromptSent,
    Proposal,
    Rejected,
    ReplyRead,
    ReplyReceived,
    Result,
    RunEnded,
    RunEvent,
    RunStarted,
    State,
    Stats,
)


@dataclass(frozen=True)
class Turn:
    """One attempt, as far as it came."""

    number: int
    """Counted from 1."""
    messages: tuple[Message, ...] = ()
    """What the model was asked; empty in a search, which asks nobody."""
    completion: Completion | None = None
    error: str = ""
    """Why no answer came."""
    reading: Proposal | Failure | None = None
    """What was read out of the answer."""
    tried: tuple[ActionTried, ...] = ()
    ended: AttemptEnded | None = None
    """None where the run was cut off."""
    time: float = 0.0
    """Of the last that is known of it, in seconds since the record began."""

    @property
    def steps(self) -> tuple[PlannedAction, ...]:
        """What was carried out."""
        return tuple(tried.step for tried in self.tried if tried.step)

    @property
    def failed(self) -> ActionTried | None:
        """The action that could not be done, if there is one."""
        return next((tried for tried in self.tried if tried.outcome.failure), None)

    @property
    def untried(self) -> tuple[Action | Rejected, ...]:
        """What was planned after that."""
        return self.reading.actions[len(self.tried) :] if isinstance(self.reading, Proposal) else ()


@dataclass(frozen=True)
class Story:
    """A recorded run."""

    run: RunFile
    start: State | None
    """None of a run that was cut off before it began."""
    turns: tuple[Turn, ...]
    result: Result | None
    """None of a run that did not end."""

    @property
    def stats(self) -> Stats:
        """What it cost; of a run that goes on, by the end of its last attempt."""
        spent = [turn.ended.stats for turn in self.turns if turn.ended]
        return spent[-1] if self.run.status == "running" and spent else self.run.stats

    @property
    def seconds(self) -> float:
        """How long it took; of a run that goes on, until the last that is known of it."""
        return self.turns[-1].time if self.run.status == "running" and self.turns else self.run.seconds

    @property
    def steps(self) -> tuple[PlannedAction, ...]:
        """The plan; of a run that found none, what the last attempt carried out."""
        if self.result and self.result.solved:
            return self.result.plan
        return self.turns[-1].steps if self.turns else ()


def read_story(folder: Path) -> Story:
    """Read a run's record, also of a run that goes on or was cut off.

    Raises:
        InputError: It is no such record, or it does not have the documented form.
    """
    run = read_run(folder)
    events = [(recorded.time, recorded.event) for recorded in read_events(folder)]
    start = next((event.state for _, event in events if isinstance(event, RunStarted)), None)
    result = next((event.result for _, event in events if isinstance(event, RunEnded)), None)
    return Story(run, start, tuple(_turns(events)), result)


def _turns(events: Sequence[tuple[float, RunEvent]]) -> Iterator[Turn]:
    turn: Turn | None = None
    for time, event in events:
        if isinstance(event, RunStarted | RunEnded):
            continue
        number = event.attempt.number if isinstance(event, AttemptEnded) else event.attempt
        if turn is None or turn.number != number:
            if turn:
                yield turn
            turn = Turn(number)
        turn = replace(_after(turn, event), time=time)
    if turn:
        yield turn


def _after(turn: Turn, event: RunEvent) -> Turn:
    if isinstance(event, PromptSent):
        return replace(turn, messages=event.messages)
    if isinstance(event, ReplyReceived):
        return replace(turn, completion=event.completion)
    if isinstance(event, CallFailed):
        return replace(turn, error=event.error)
    if isinstance(event, ReplyRead):
        return replace(turn, reading=event.proposal)
    if isinstance(event, ActionTried):
        return replace(turn, tried=(*turn.tried, event))
    return replace(turn, ended=event) if isinstance(event, AttemptEnded) else turn
