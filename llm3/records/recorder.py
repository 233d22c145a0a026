"""Writes a run's record while the run goes on."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import replace
from pathlib import Path
from time import perf_counter
from types import TracebackType
from typing import Literal

from llm3.assembly import Run
from llm3.errors import LLM3Error
from llm3.jsonio import pretty
from llm3.records.event_lines import EVENTS_FORMAT, fields_of
from llm3.records.json_lines import LineWriter
from llm3.records.plan import plan_file
from llm3.records.run_file import run_file
from llm3.records.tally import Tally
from llm3.records.whole_file import write_whole
from llm3.types import AttemptEnded, RunEnded, RunEvent


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
        self._file = run_file(run)
        self._tally = Tally()
        self._events = LineWriter(folder / "events.jsonl", EVENTS_FORMAT)
        try:
            self._write_run()
        except BaseException:
            self._events.close()
            raise

    def __enter__(self) -> Recorder:
        return self

    def __call__(self, event: RunEvent) -> None:
        """Note one event."""
        if isinstance(event, RunEnded) and event.result.solved:  # before the line that promises a plan
            write_whole(
                self.folder / "plan.json", pretty(plan_file(self._run.problem, event.result.start, event.result.plan))
            )
        self._events.write({"event": type(event).__name__, "time": round(self.seconds, 3), **fields_of(event)})
        self._tally(event)
        if isinstance(event, AttemptEnded):
            self._file = replace(self._file, unmet=event.attempt.goal.unmet)
        elif isinstance(event, RunEnded):
            result = event.result
            status: Literal["solved", "not solved"] = "solved" if result.solved else "not solved"
            self._file = replace(
                self._file,
                status=status,
                unmet=result.goal.unmet,
                time_limited=result.time_limited,
                stop=result.stop,
            )

    def __exit__(
        self, kind: type[BaseException] | None, error: BaseException | None, traceback: TracebackType | None
    ) -> None:
        if isinstance(error, KeyboardInterrupt):
            self._file = replace(self._file, status="interrupted")
        elif isinstance(error, LLM3Error):
            self._file = replace(self._file, status="error", error=str(error))
        elif error is not None:
            self._file = replace(self._file, status="error", error=f"{type(error).__name__}: {error}")
        self._events.close()
        self._write_run()

    @property
    def seconds(self) -> float:
        """Seconds since the record began."""
        return self._clock() - self._began

    def _write_run(self) -> None:
        self._file = replace(self._file, stats=self._tally.stats, seconds=round(self.seconds, 3))
        write_whole(self.folder / "run.json", pretty(self._file))
