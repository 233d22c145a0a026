"""Text on its way to a terminal or a pipe: made safe to show, and no trouble when nobody reads it."""

from __future__ import annotations

import os
import sys
from typing import TextIO


def printable(text: str, keep_spaces: bool = False, indent: int = 0) -> str:
    """One line without control characters, whoever wrote it."""
    line = text if keep_spaces else " ".join(text.split())
    return " " * indent + "".join(c if c.isprintable() else " " for c in line).rstrip()


def emit(text: str) -> None:
    """Write a result to stdout, now. A reader that has left, such as `head`, is no error."""
    try:
        sys.stdout.write(text)
        sys.stdout.flush()
    except BrokenPipeError:
        discard(sys.stdout)


def discard(stream: TextIO) -> None:
    """Send the rest of a stream nowhere, as its reader is gone: the flush at exit would fail again."""
    nowhere = os.open(os.devnull, os.O_WRONLY)
    os.dup2(nowhere, stream.fileno())
    os.close(nowhere)
