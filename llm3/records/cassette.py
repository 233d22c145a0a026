"""A cassette: every exchange of a run with its model, in one file."""

from __future__ import annotations

import os
from collections.abc import Callable, Iterator
from pathlib import Path
from time import perf_counter
from types import TracebackType

from llm3.assembly import Run
from llm3.errors import LLM3Error, OutputExists
from llm3.jsonio import loads
from llm3.records.exchange import Exchange
from llm3.records.folder import RECORD_FILES
from llm3.records.json_lines import LineWriter, read_lines
from llm3.records.pairing import Pairing
from llm3.types import RunEvent

CASSETTE_FORMAT = "llm3-cassette/1"


class CassetteRecorder:
    """An observer that writes every exchange as one line, flushed at once. Use it in a ``with``."""

    def __init__(self, path: Path, run: Run, force: bool = False, clock: Callable[[], float] = perf_counter) -> None:
        """Begin the file.

        Args:
            path: The file; its folder is made if need be.
            run: What is about to be solved.
            force: Whether to overwrite a file that is there.
            clock: Seconds, to measure how long an answer takes.

        Raises:
            OutputExists: There is such a file, and `force` is not given.
            LLM3Error: It cannot be written.
        """
        check_cassette(path, force)
        self._clock = clock
        self._pairing = Pairing(run.config, run.solver.language_model)
        try:
            path.parent.mkdir(parents=True, exist_ok=True)
            self._lines = LineWriter(path, CASSETTE_FORMAT, force)
        except OSError as error:
            raise _unwritable(path, error.strerror or str(error)) from error

    def __enter__(self) -> CassetteRecorder:
        return self

    def __call__(self, event: RunEvent) -> None:
        """Note one event."""
        exchange = self._pairing.after(event, self._clock())
        if exchange:
            self._lines.write(exchange)

    def __exit__(
        self, kind: type[BaseException] | None, error: BaseException | None, traceback: TracebackType | None
    ) -> None:
        self._lines.close()


def check_cassette(path: Path, force: bool) -> None:
    """See that a cassette can be written there, before anything else is overwritten.

    Raises:
        OutputExists: There is a folder, or a file and `force` is not given, or the record may come there.
        LLM3Error: It cannot be written.
    """
    if path.is_dir():
        raise OutputExists(f"'{path}' is a folder, so no cassette can be written there.")
    if path.name in RECORD_FILES:
        raise OutputExists(f"'{path}' has the name of a file of the record: choose another for the cassette.")
    if path.exists() and not force:
        raise OutputExists(f"the cassette '{path}' exists: choose another file, or give --force.")
    above = path if path.exists() else next(folder for folder in path.absolute().parents if folder.exists())
    if not above.is_dir() and above != path:
        raise _unwritable(path, "Not a directory")
    if not os.access(above, os.W_OK):
        raise _unwritable(path, "Permission denied")


def _unwritable(path: Path, reason: str) -> LLM3Error:
    return LLM3Error(f"the cassette '{path}' cannot be written: {reason}.")


def read_cassette(path: Path) -> Iterator[Exchange]:
    """The exchanges of a cassette, in order; of one that was cut off, all up to there.

    Cassettes can be joined by writing one after the other into a file.

    Raises:
        InputError: A line is not as documented; the error names it.
    """
    for source, text in read_lines(path, CASSETTE_FORMAT):
        yield loads(text, Exchange, source)
