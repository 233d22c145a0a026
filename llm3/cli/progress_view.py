"""How far something has come that takes a while, on stderr: a live bar in a terminal, a line at the end in a pipe."""

from __future__ import annotations

from types import TracebackType

from rich.progress import BarColumn, MofNCompleteColumn, Progress, TextColumn

from llm3.cli.console import ViewConsole
from llm3.wording import counted


class ProgressView:
    """Use it in a ``with`` while things are made."""

    def __init__(self, noun: str, total: int, quiet: bool) -> None:
        """Expect so many things, which the noun calls by their name."""
        self._console, self._noun, self._total = ViewConsole(quiet), noun, total
        columns = (TextColumn(f"{noun}s"), BarColumn(), MofNCompleteColumn())
        self._progress = Progress(*columns, console=self._console, disable=not self._console.is_live)
        self._task = self._progress.add_task("", total=total)

    def advance(self) -> None:
        """One more is made."""
        self._progress.advance(self._task)

    def __enter__(self) -> ProgressView:
        self._progress.start()
        return self

    def __exit__(
        self, kind: type[BaseException] | None, error: BaseException | None, traceback: TracebackType | None
    ) -> None:
        self._progress.stop()
        if error is None and not self._console.is_live:
            self._console.tell(counted(self._total, self._noun))
