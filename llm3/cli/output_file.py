"""The one file that a command writes: not over another one unasked, and whole or not at all."""

from __future__ import annotations

from pathlib import Path

from llm3.errors import LLM3Error, OutputExists
from llm3.records.whole_file import write_whole


def check_free(file: Path, force: bool) -> None:
    """See that nothing is overwritten unasked.

    Raises:
        OutputExists: There is such a file, and `force` is not given.
    """
    if file.exists() and not force:
        raise OutputExists(f"'{file}' exists: choose another file, or give --force.")


def write_file(file: Path, content: str | bytes) -> None:
    """Write it.

    Raises:
        LLM3Error: It cannot be written.
    """
    try:
        write_whole(file, content)
    except OSError as error:
        raise LLM3Error(f"'{file}' cannot be written: {error.strerror or error}.") from error
