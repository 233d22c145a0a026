"""run.json: what was asked, with which versions, and what came of it."""

from __future__ import annotations

import platform
from collections.abc import Mapping
from dataclasses import dataclass, field
from importlib import metadata
from pathlib import Path
from typing import Any, Literal

from llm3.assembly import Run, RunConfig
from llm3.errors import InputError
from llm3.jsonio import read_stated, to_builtins
from llm3.types import FrozenDict, Stats

RUN_FORMAT = "llm3-run/1"
VERSIONED = ("llm3", "numpy", "scipy", "pybullet", "ompl", "toppra")


@dataclass(frozen=True)
class RunFile:
    """run.json: what was asked, with which versions, and what came of it."""

    format: str
    status: Literal["running", "solved", "not solved", "interrupted", "error"]
    config: RunConfig
    language_model: bool
    """False where no language model was used."""
    notice: str
    """What the backend, or the search, has to say about itself."""
    instance: Any
    """The domain's instance as JSON."""
    options: Mapping[str, str]
    """The domain's options, all of them."""
    versions: Mapping[str, str]
    plugins: Mapping[str, str] = field(default_factory=FrozenDict)
    """Where the plugins that it used come from, by kind and name."""
    stats: Stats = field(default=Stats())
    unmet: tuple[str, ...] = ()
    """What of the goal is missing."""
    time_limited: bool = False
    """Whether a wall-clock guard cut something off, so that a second run may differ."""
    seconds: float = 0.0
    error: str = ""
    stop: str = ""
    """Why it ended, as `Result.stop` says; empty for a run that did not."""

    def __post_init__(self) -> None:
        if self.format != RUN_FORMAT:
            raise ValueError(f"the format is {self.format!r}, and this version reads {RUN_FORMAT!r}")
        object.__setattr__(self, "options", FrozenDict(self.options))
        object.__setattr__(self, "versions", FrozenDict(self.versions))
        object.__setattr__(self, "plugins", FrozenDict(self.plugins))


def run_file(run: Run) -> RunFile:
    """What is known of a run before it begins."""
    return RunFile(
        RUN_FORMAT,
        "running",
        run.config,
        run.solver.language_model,
        run.solver.notice,
        to_builtins(run.problem.instance),
        run.problem.options,
        versions(),
        run.plugins,
    )


def read_run(folder: Path) -> RunFile:
    """Read what was asked of a recorded run, and what came of it.

    Args:
        folder: The run's folder.

    Raises:
        InputError: It holds no run.json, or one that does not have the documented form.
    """
    path = folder / "run.json"
    if not folder.exists():
        raise InputError(f"{folder}: No such file or directory")
    if not path.exists():
        raise InputError(f"'{folder}' holds no run.json: it is not the folder of a run.")
    return read_stated(path, RunFile, RUN_FORMAT)


def versions() -> Mapping[str, str]:
    """The versions that a result may depend on."""
    found = {"python": platform.python_version(), "platform": platform.platform()}
    for name in VERSIONED:
        try:
            found[name] = metadata.version(name)
        except metadata.PackageNotFoundError:
            found[name] = "not installed"
    return FrozenDict(found)
