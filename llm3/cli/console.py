"""The console for whatever goes on meanwhile: stderr, where nobody has to listen."""

from __future__ import annotations

import sys
from textwrap import wrap

from rich.console import Console
from rich.text import Text

from llm3.cli.text import discard

FOLDED = 8
"""Columns by which the rest of a line stands in."""


class ViewConsole(Console):
    """Writes to stderr, in colour where that is a terminal."""

    def __init__(self, quiet: bool) -> None:
        """Open it.

        Args:
            quiet: Write nothing at all.
        """
        super().__init__(stderr=True, quiet=quiet, highlight=False, markup=False, soft_wrap=True)

    def tell(self, text: str, style: str = "") -> None:
        """Show one line. In a terminal it is folded between words, and what goes on below it stands in a little."""
        lines = wrap(text, self.width, subsequent_indent=" " * FOLDED) if self.is_terminal else [text]
        self.print(Text("\n".join(lines), style=style))

    @property
    def is_live(self) -> bool:
        """Whether what was written can be written over."""
        return self.is_terminal and not self.is_dumb_terminal and not self.quiet

    def on_broken_pipe(self) -> None:
        """Whoever watched has left; the work goes on, and its result is for stdout."""
        self.quiet = True
        discard(sys.stderr)
