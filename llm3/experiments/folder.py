"""The folder of an experiment: what was asked, and a line for each run that ended."""

from __future__ import annotations

import re
from collections.abc import Mapping
from dataclasses import dataclass
from hashlib import sha256
from pathlib import Path

from llm3.errors import InputError
from llm3.experiments.experiment import Experiment, ProblemFamily, RunKey
from llm3.experiments.run_line import RunLine
from llm3.jsonio import loads, read_stated
from llm3.records.json_lines import read_lines
from llm3.types import FrozenDict

EXPERIMENT_FORMAT = "llm3-experiment/1"
RUNS_FORMAT = "llm3-experiment-runs/1"
LONGEST_STEM = 60
EXPERIMENT_FILE, RUNS_FILE, RECORDS = "experiment.json", "runs.jsonl", "records"


@dataclass(frozen=True)
class ExperimentFile:
    """experiment.json: what was asked, and with which versions."""

    format: str
    experiment: Experiment
    versions: Mapping[str, str]
    """Of the packages that a result may depend on, and of the plugins that the methods use."""
    earlier: tuple[Mapping[str, str], ...] = ()
    """Other versions that some of the runs were made with, those that differ alone."""

    def __post_init__(self) -> None:
        if self.format != EXPERIMENT_FORMAT:
            raise ValueError(f"the format is {self.format!r}, and this version reads {EXPERIMENT_FORMAT!r}")
        object.__setattr__(self, "versions", FrozenDict(self.versions))
        object.__setattr__(self, "earlier", tuple(map(FrozenDict, self.earlier)))


@dataclass(frozen=True)
class ExperimentRecord:
    """What is known of an experiment, which may still be going on."""

    folder: Path
    experiment: Experiment
    versions: Mapping[str, str]
    runs: Mapping[RunKey, RunLine]
    """Those that ended, in the experiment's order: by seed, problem and method."""
    earlier: tuple[Mapping[str, str], ...] = ()
    """Other versions that some of them were made with."""
    strangers: int = 0
    """Lines of runs that the experiment does not have."""

    @property
    def begun(self) -> tuple[ProblemFamily, ...]:
        """The problems of which some run has ended; all of them where none has."""
        names = {key.problem for key in self.runs}
        return tuple(p for p in self.experiment.problems if p.name in names) or self.experiment.problems

    @property
    def missing(self) -> int:
        """How many runs have not ended."""
        return len(self.experiment) - len(self.runs)


def read_experiment_folder(folder: Path) -> ExperimentRecord:
    """Read an experiment's folder, also of one that is going on or was cut off.

    Raises:
        InputError: It is no such folder, or something in it does not have the documented form.
    """
    file = read_experiment_file(folder)
    ended = read_runs(folder / RUNS_FILE)
    ours = FrozenDict({key: ended[key] for key in keys_of(file.experiment) if key in ended})
    return ExperimentRecord(folder, file.experiment, file.versions, ours, file.earlier, len(ended) - len(ours))


def read_experiment_file(folder: Path) -> ExperimentFile:
    """What was asked in an experiment's folder, and with which versions.

    Raises:
        InputError: It is no such folder, or its experiment.json does not have the documented form.
    """
    path = folder / EXPERIMENT_FILE
    if not folder.exists():
        raise InputError(f"{folder}: No such file or directory")
    if not path.exists():
        raise InputError(f"'{folder}' holds no {EXPERIMENT_FILE}: it is not the folder of an experiment.")
    return read_stated(path, ExperimentFile, EXPERIMENT_FORMAT)


def read_runs(path: Path) -> dict[RunKey, RunLine]:
    """The last line of each run; a line that was cut off counts as none.

    Raises:
        InputError: The file cannot be read, or a line does not have the documented form.
    """
    if not path.exists():
        return {}
    lines = (loads(text, RunLine, source) for source, text in read_lines(path, RUNS_FORMAT))
    return {line.key: line for line in lines}


def keys_of(experiment: Experiment) -> list[RunKey]:
    """All runs of an experiment, in order."""
    return [
        RunKey(method.name, problem.name, seed)
        for seed in experiment.seeds
        for problem in experiment.problems
        for method in experiment.methods
    ]


def record_folder(key: RunKey) -> Path:
    """Where, below the experiment's folder, the record of a run stands."""
    return Path(RECORDS, folder_name(key.method), folder_name(key.problem), str(key.seed))


def folder_name(name: str) -> str:
    """A folder's name for a method or a problem, which any file system takes.

    Two names never share one: what is lost on the way is made up for by a digest of the name.
    """
    stem = re.sub(r"[^a-z0-9.]+", "-", name.lower()).strip("-.")[:LONGEST_STEM].strip("-.")
    return stem if stem == name else f"{stem}~{sha256(name.encode()).hexdigest()[:8]}"
