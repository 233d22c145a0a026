"""How far a film has come, on stderr: a live bar in a terminal, a line at the end in a pipe."""

from __future__ import annotations

from types import TracebackType

from rich.progress import BarColumn, MofNCompleteColumn, Progress, TextColumn
from rich.text import Text

from llm3.cli.console import ViewConsole
from llm3.wording import counted


class RenderView:
    """Use it in a ``with`` while pictures are made."""

    def __init__(self, total: int, quiet: bool) -> None:
        """Expect so many pictures."""
        self._console, self._total = ViewConsole(quiet), total
        columns = (TextColumn("pictures"), BarColumn(), MofNCompleteColumn())
        self._progress = Progress(*columns, console=self._console, disable=not self._console.is_live)
        self._task = self._progress.add_task("", total=total)

    def advance(self) -> None:
        """One more is made."""
        self._progress.advance(self._task)

    def __enter__(self) -> RenderView:
        self._progress.start()
        return self

    def __exit__(
        self, kind: type[BaseException] | None, error: BaseException | None, traceback: TracebackType | None
    ) -> None:
        self._progress.stop()
        if error is None and not self._console.is_live:
            self._console.print(Text(counted(self._total, "picture")))
