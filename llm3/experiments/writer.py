"""Writes the folder of an experiment: one program at a time, one line for each run, readable at every moment."""

from __future__ import annotations

from collections.abc import Mapping
from contextlib import ExitStack
from pathlib import Path
from types import TracebackType

from filelock import FileLock, Timeout

from llm3.errors import LLM3Error
from llm3.experiments.continuation import LOCK, check_place, continued
from llm3.experiments.experiment import Experiment, RunKey
from llm3.experiments.folder import EXPERIMENT_FILE, RUNS_FILE, RUNS_FORMAT
from llm3.experiments.run_line import RunLine
from llm3.jsonio import pretty
from llm3.records.json_lines import LineWriter
from llm3.records.whole_file import write_whole


class ExperimentWriter:
    """The folder of an experiment, held by this program until the ``with`` ends."""

    def __init__(
        self, folder: Path, experiment: Experiment, versions: Mapping[str, str], mix_versions: bool = False
    ) -> None:
        """Say what is to be written where; nothing is touched before the ``with``.

        Args:
            folder: The folder, which need not exist.
            experiment: What is asked, all of it: what has no runs yet has its place in tables all the same.
            versions: What its results may depend on.
            mix_versions: Whether to go on where other versions began.
        """
        self.folder = folder
        self._experiment, self._versions, self._mix_versions = experiment, versions, mix_versions
        self._stack = ExitStack()
        self.ended: dict[RunKey, RunLine] = {}
        """What was found in the folder, and what was added."""

    def __enter__(self) -> ExperimentWriter:
        """Take hold of the folder.

        Raises:
            OutputExists: It holds something else, or another experiment, or one that other versions made.
            LLM3Error: Another program writes it, or it cannot be written.
        """
        with self._stack:
            try:
                self._take_hold()
            except OSError as error:
                raise self._unwritable(error) from error
            self._stack = self._stack.pop_all()
        return self

    def __exit__(
        self, kind: type[BaseException] | None, error: BaseException | None, traceback: TracebackType | None
    ) -> None:
        self._stack.close()

    def add(self, line: RunLine) -> None:
        """Keep what came of a run.

        Raises:
            LLM3Error: It cannot be written, such as on a full disk.
        """
        try:
            self._lines.write(line)
        except OSError as error:
            raise self._unwritable(error) from error
        self.ended[line.key] = line

    def _unwritable(self, error: OSError) -> LLM3Error:
        return LLM3Error(f"the output folder '{self.folder}' cannot be written: {error.strerror or error}.")

    def _take_hold(self) -> None:
        check_place(self.folder)
        self.folder.mkdir(parents=True, exist_ok=True)
        lock = FileLock(self.folder / LOCK)
        try:
            self._stack.enter_context(lock.acquire(blocking=False))
        except Timeout:
            raise LLM3Error(
                f"another program is writing '{self.folder}': wait for it, or choose another folder."
            ) from None
        file, self.ended = continued(self.folder, self._experiment, self._versions, self._mix_versions)
        write_whole(self.folder / EXPERIMENT_FILE, pretty(file))
        self._lines = LineWriter(self.folder / RUNS_FILE, RUNS_FORMAT, go_on=True)
        self._stack.callback(self._lines.close)
