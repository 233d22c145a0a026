"""Text on its way to a terminal or a pipe: made safe to show, and no trouble when nobody reads it."""

from __future__ import annotations

import os
import sys
from io import TextIOWrapper
from typing import TextIO


def printable(text: str, keep_spaces: bool = False, indent: int = 0) -> str:
    """One line without control characters, whoever wrote it."""
    line = text if keep_spaces else " ".join(text.split())
    return " " * indent + "".join(c if c.isprintable() else " " for c in line).rstrip()


def emit(text: str, out: TextIO) -> None:
    """Write a result, now. A reader that has left, such as `head`, is no error."""
    try:
        out.write(text)
        out.flush()
    except BrokenPipeError:
        discard(out)


def open_streams() -> None:
    """Make sure that stdout and stderr can be written to, also where they are closed or cannot spell a name."""
    for name, descriptor in (("stdout", 1), ("stderr", 2)):
        if getattr(sys, name) is None:  # closed by whoever started the program, as by ``2>&-``
            nowhere = os.open(os.devnull, os.O_WRONLY)
            if nowhere != descriptor:
                os.dup2(nowhere, descriptor)
                os.close(nowhere)
            setattr(sys, name, os.fdopen(descriptor, "w", encoding="utf-8", closefd=False))
        elif isinstance(stream := getattr(sys, name), TextIOWrapper):
            stream.reconfigure(errors="backslashreplace")


def discard(stream: TextIO) -> None:
    """Send the rest of a stream nowhere, as its reader is gone: the flush at exit would fail again."""
    nowhere = os.open(os.devnull, os.O_WRONLY)
    os.dup2(nowhere, stream.fileno())
    os.close(nowhere)
