"""How an experiment goes on, on stderr: a live bar in a terminal, a line now and then in a pipe."""

from __future__ import annotations

from collections.abc import Callable
from time import monotonic
from types import TracebackType

from rich.progress import BarColumn, MofNCompleteColumn, Progress, TextColumn

from llm3.cli.console import ViewConsole
from llm3.cli.text import printable
from llm3.experiments import RunLine

PAUSE = 5.0
"""Seconds between two lines in a pipe."""


class ExperimentView:
    """Shows how many runs have ended, and how. Use it in a ``with`` while the experiment goes on."""

    def __init__(self, total: int, done: int, quiet: bool, clock: Callable[[], float] = monotonic) -> None:
        """Start with what was done before.

        Args:
            total: The runs of the whole experiment.
            done: Those that had ended before.
            quiet: Show nothing at all.
            clock: Seconds.
        """
        self._console = ViewConsole(quiet)
        self._total, self._before, self._clock = total, done, clock
        self._ended = self._solved = self._failed = self._tokens = 0
        self._began = self._told = clock()
        self._progress: Progress | None = None
        if self._console.is_live:
            columns = (BarColumn(), MofNCompleteColumn(), TextColumn("{task.description}"))
            self._progress = Progress(*columns, console=self._console)
            self._task = self._progress.add_task("", total=total, completed=done)

    def __enter__(self) -> ExperimentView:
        if self._progress:
            self._progress.start()
        return self

    def __exit__(
        self, kind: type[BaseException] | None, error: BaseException | None, traceback: TracebackType | None
    ) -> None:
        if self._progress:
            self._progress.stop()

    def note(self, text: str) -> None:
        """Show a line that is not part of the progress."""
        self._line(text, "yellow")

    def __call__(self, line: RunLine) -> None:
        """Show that a run has ended."""
        self._ended += 1
        self._solved += line.solved
        self._tokens += line.stats.tokens
        if line.failed:
            self._failed += 1
            self._line(f"{line.key}: {line.status}: {line.error}", "red")
        now = self._clock()
        if self._progress:
            self._progress.update(self._task, advance=1, description=self._summary(now))
        elif now - self._told >= PAUSE or self._before + self._ended == self._total:
            self._told = now
            self._line(f"{self._before + self._ended} of {self._total} runs: {self._summary(now)}")

    def _summary(self, now: float) -> str:
        rate = self._ended / max(now - self._began, 1e-9)
        left = (self._total - self._before - self._ended) / rate
        parts = [f"{self._solved} solved of {self._ended}", f"{60 * rate:.3g} a minute", f"{duration(left)} left"]
        parts += [f"{self._failed} failed"] if self._failed else []
        parts += [f"{self._tokens:,} tokens"] if self._tokens else []
        return ", ".join(parts)

    def _line(self, text: str, style: str = "") -> None:
        self._console.tell(printable(text), style)


def duration(seconds: float) -> str:
    """Hours and minutes, or minutes and seconds."""
    minutes, rest = divmod(round(seconds), 60)
    hours, minutes = divmod(minutes, 60)
    return f"{hours} h {minutes:02} min" if hours else f"{minutes} min {rest:02} s" if minutes else f"{rest} s"
