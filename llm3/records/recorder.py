"""Writes a run's record while the run goes on."""

from __future__ import annotations

import os
import platform
from collections.abc import Callable, Mapping
from dataclasses import dataclass, field, replace
from importlib import metadata
from pathlib import Path
from time import perf_counter
from types import TracebackType
from typing import Any, Literal

from llm3.assembly import Run, RunConfig
from llm3.errors import LLM3Error
from llm3.jsonio import dumps, pretty, to_builtins
from llm3.records.plan import plan_file
from llm3.types import ActionTried, AttemptEnded, CallFailed, FrozenDict, ReplyReceived, RunEnded, RunEvent, Stats

RUN_FORMAT = "llm3-run/1"
EVENTS_FORMAT = "llm3-events/1"
VERSIONED = ("llm3", "numpy", "scipy", "pybullet", "ompl", "toppra")


@dataclass(frozen=True)
class RunFile:
    """run.json: what was asked, with which versions, and what came of it."""

    format: str
    status: Literal["running", "solved", "not solved", "interrupted", "error"]
    config: RunConfig
    language_model: bool
    """False where no language model was used."""
    notice: str
    """What the backend has to say about itself."""
    instance: Any
    versions: Mapping[str, str]
    stats: Stats = field(default=Stats())
    unmet: tuple[str, ...] = ()
    """What of the goal is missing."""
    time_limited: bool = False
    """Whether a wall-clock guard cut something off, so that a second run may differ."""
    seconds: float = 0.0
    error: str = ""
    stop: str = ""
    """Why it ended, as `Result.stop` says; empty for a run that did not."""


class Recorder:
    """An observer that writes every event as one line of events.jsonl, flushed at once.

    Use it in a ``with``: whatever ends the block, run.json says how the run ended.
    """

    def __init__(self, folder: Path, run: Run, clock: Callable[[], float] = perf_counter) -> None:
        """Begin the record.

        Args:
            folder: An existing folder.
            run: What is about to be solved.
            clock: Seconds, for the times of events.
        """
        self.folder = folder
        self._run, self._clock, self._began = run, clock, clock()
        self._file = RunFile(
            RUN_FORMAT,
            "running",
            run.config,
            run.backend.is_language_model,
            run.backend.notice,
            to_builtins(run.problem.instance),
            versions(),
        )
        self._write()
        self._events = (folder / "events.jsonl").open("w", encoding="utf-8")
        self._line({"format": EVENTS_FORMAT})

    def __enter__(self) -> Recorder:
        return self

    def __call__(self, event: RunEvent) -> None:
        """Note one event."""
        self._line({"event": type(event).__name__, "time": round(self.seconds, 3), **_fields(event)})
        if isinstance(event, ReplyReceived):  # paid for, even if the run is cut off before the attempt ends
            spent = event.completion.stats + Stats(llm_calls=1)
            self._file = replace(self._file, stats=self._file.stats + spent)
        elif isinstance(event, CallFailed):
            self._file = replace(self._file, stats=self._file.stats + event.stats)
        elif isinstance(event, AttemptEnded):
            self._file = replace(self._file, stats=event.stats, unmet=event.attempt.goal.unmet)
        elif isinstance(event, RunEnded):
            result = event.result
            status: Literal["solved", "not solved"] = "solved" if result.solved else "not solved"
            self._file = replace(
                self._file,
                status=status,
                stats=result.stats,
                unmet=result.goal.unmet,
                time_limited=result.time_limited,
                stop=result.stop,
            )
            if result.solved:
                text = pretty(plan_file(self._run.problem, result))
                (self.folder / "plan.json").write_text(text, encoding="utf-8")

    def __exit__(
        self, kind: type[BaseException] | None, error: BaseException | None, traceback: TracebackType | None
    ) -> None:
        if isinstance(error, KeyboardInterrupt):
            self._file = replace(self._file, status="interrupted")
        elif isinstance(error, LLM3Error):
            self._file = replace(self._file, status="error", error=str(error))
        elif error is not None:
            self._file = replace(self._file, status="error", error=f"{type(error).__name__}: {error}")
        self._write()
        self._events.close()

    @property
    def seconds(self) -> float:
        """Seconds since the record began."""
        return self._clock() - self._began

    def _write(self) -> None:
        self._file = replace(self._file, seconds=round(self.seconds, 3))
        # Written beside and moved into place: a run that is killed leaves the old file or the new one.
        beside = self.folder / f"run.json.{os.getpid()}.new"
        with beside.open("x", encoding="utf-8") as file:
            file.write(pretty(self._file))
        beside.replace(self.folder / "run.json")

    def _line(self, data: Mapping[str, Any]) -> None:
        self._events.write(dumps(data) + "\n")
        self._events.flush()


def versions() -> Mapping[str, str]:
    """The versions that a result may depend on."""
    found = {"python": platform.python_version(), "platform": platform.platform()}
    for name in VERSIONED:
        try:
            found[name] = metadata.version(name)
        except metadata.PackageNotFoundError:
            found[name] = "not installed"
    return FrozenDict(found)


def _fields(event: RunEvent) -> dict[str, Any]:
    """The fields of an event, without what earlier lines have said already."""
    if isinstance(event, AttemptEnded):
        attempt = event.attempt
        return {
            "attempt": attempt.number,
            "goal": attempt.goal,
            "feedback": event.feedback,
            "stats": event.stats,
        }
    if isinstance(event, ActionTried) and event.outcome.reused:
        return {"attempt": event.attempt, "index": event.index, "outcome": event.outcome}
    if isinstance(event, RunEnded):
        return {"solved": event.result.solved, "stop": event.result.stop, "stats": event.result.stats}
    return {name: getattr(event, name) for name in event.__dataclass_fields__}
