"""Writes the folder of an experiment: one program at a time, one line for each run, readable at every moment."""

from __future__ import annotations

from collections.abc import Mapping
from contextlib import ExitStack
from dataclasses import replace
from pathlib import Path
from types import TracebackType

from filelock import FileLock, Timeout

from llm3.errors import LLM3Error, OutputExists
from llm3.experiments.continuation import differences, joined, version_differences
from llm3.experiments.experiment import Experiment, RunKey
from llm3.experiments.folder import (
    EXPERIMENT_FILE,
    EXPERIMENT_FORMAT,
    RUNS_FILE,
    RUNS_FORMAT,
    ExperimentFile,
    read_runs,
)
from llm3.experiments.run_line import RunLine
from llm3.jsonio import pretty, read_file
from llm3.records.json_lines import LineWriter
from llm3.records.whole_file import write_whole

LOCK = "lock"


class ExperimentWriter:
    """The folder of an experiment, held by this program until the ``with`` ends."""

    def __init__(self, folder: Path, experiment: Experiment, versions: Mapping[str, str], extend: bool = False) -> None:
        """Say what is to be written where; nothing is touched before the ``with``.

        Args:
            folder: The folder, which need not exist.
            experiment: What is asked.
            versions: What its results may depend on.
            extend: Whether to go on where another selection of the experiment, or another version, began.
        """
        self.folder = folder
        self._asked = ExperimentFile(EXPERIMENT_FORMAT, experiment, versions)
        self._extend = extend
        self._stack = ExitStack()
        self.ended: dict[RunKey, RunLine] = {}
        """What was found in the folder, and what was added."""

    def __enter__(self) -> ExperimentWriter:
        """Take hold of the folder.

        Raises:
            OutputExists: It holds something else, or another experiment, or one that another version made.
            LLM3Error: Another program writes it, or it cannot be written.
        """
        with self._stack:
            try:
                self._take_hold()
            except OSError as error:
                what = error.strerror or error
                raise LLM3Error(f"the output folder '{self.folder}' cannot be written: {what}.") from error
            self._stack = self._stack.pop_all()
        return self

    def __exit__(
        self, kind: type[BaseException] | None, error: BaseException | None, traceback: TracebackType | None
    ) -> None:
        self._stack.close()

    def add(self, line: RunLine) -> None:
        """Keep what came of a run."""
        self._lines.write(line)
        self.ended[line.key] = line

    def _take_hold(self) -> None:
        if self.folder.exists() and not self.folder.is_dir():
            raise OutputExists(f"'{self.folder}' is a file, not a folder: choose another.")
        path = self.folder / EXPERIMENT_FILE
        if self.folder.exists() and not path.exists() and any(f.name != LOCK for f in self.folder.iterdir()):
            raise OutputExists(
                f"the output folder '{self.folder}' is not empty and holds no experiment: choose another."
            )
        self.folder.mkdir(parents=True, exist_ok=True)
        lock = FileLock(self.folder / LOCK)
        try:
            self._stack.enter_context(lock.acquire(blocking=False))
        except Timeout:
            raise LLM3Error(
                f"another program is writing '{self.folder}': wait for it, or choose another folder."
            ) from None
        file = self._continued(read_file(path, ExperimentFile)) if path.exists() else self._asked
        self.ended = read_runs(self.folder / RUNS_FILE)
        write_whole(path, pretty(file))
        self._lines = LineWriter(self.folder / RUNS_FILE, RUNS_FORMAT, go_on=True)
        self._stack.callback(self._lines.close)

    def _continued(self, found: ExperimentFile) -> ExperimentFile:
        """What experiment.json says from now on."""
        asked, there = self._asked, found.experiment
        if not self._extend:
            changes = (
                *differences(there, asked.experiment),
                *version_differences(found.versions, asked.versions),
            )
            for change in changes:
                raise OutputExists(
                    f"'{self.folder}' holds another experiment: {change}. Choose another folder, or give --extend to "
                    "go on with both."
                )
        return replace(asked, experiment=joined(there, asked.experiment))
