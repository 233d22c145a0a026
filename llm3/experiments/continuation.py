"""Whether an experiment may go on in a folder, and what the folder holds then."""

from __future__ import annotations

from collections.abc import Collection, Iterable, Iterator, Mapping, Sequence
from dataclasses import replace
from pathlib import Path
from typing import Any, TypeVar

from llm3.errors import OutputExists
from llm3.experiments.experiment import Experiment, Method, ProblemFamily, RunKey
from llm3.experiments.folder import (
    EXPERIMENT_FILE,
    EXPERIMENT_FORMAT,
    RUNS_FILE,
    ExperimentFile,
    read_experiment_file,
    read_runs,
)
from llm3.experiments.run_line import RunLine
from llm3.records.whole_file import is_beside
from llm3.types import FrozenDict

N = TypeVar("N", bound=Method | ProblemFamily)

LOCK = "lock"
"""The file that a program holds while it writes the folder."""


def check_place(folder: Path) -> None:
    """See that a folder can be that of an experiment.

    Raises:
        OutputExists: It is a file, or something else is in it.
    """
    if folder.exists() and not folder.is_dir():
        raise OutputExists(f"'{folder}' is a file, not a folder: choose another.")
    if folder.exists() and not (folder / EXPERIMENT_FILE).exists() and not all(map(_is_ours, folder.iterdir())):
        raise OutputExists(f"the output folder '{folder}' is not empty and holds no experiment: choose another.")


def _is_ours(path: Path) -> bool:
    """Whether a file may be there before there is an experiment, as after a program that was killed at once."""
    return path.name == LOCK or is_beside(path, EXPERIMENT_FILE)


def continued(
    folder: Path, asked: Experiment, versions: Mapping[str, str], mix_versions: bool = False
) -> tuple[ExperimentFile, dict[RunKey, RunLine]]:
    """What a folder's experiment.json has to say from now on, and the runs that ended. Nothing is touched.

    Args:
        folder: The folder, which need not exist.
        asked: What is asked now.
        versions: What its results may depend on.
        mix_versions: Whether to go on where other versions began.

    Raises:
        OutputExists: Something else is there, or another experiment, or one that other versions made.
        InputError: Something in it does not have the documented form.
    """
    check_place(folder)
    ended = read_runs(folder / RUNS_FILE)
    if not (folder / EXPERIMENT_FILE).exists():
        return ExperimentFile(EXPERIMENT_FORMAT, asked, versions), ended
    found = read_experiment_file(folder)
    for difference in _differences(found.experiment, asked, ended):
        raise OutputExists(f"'{folder}' holds another experiment: {difference}. Choose another folder.")
    changed = _version_differences(found.versions, versions) if ended else {}
    for name, version in changed.items():
        if not mix_versions:
            raise OutputExists(
                f"'{folder}' was made with {name} {version}, and here is {versions[name]}: choose another folder, or "
                "give --mix-versions to go on with both."
            )
    file = ExperimentFile(
        EXPERIMENT_FORMAT,
        _joined(found.experiment, asked, ended),
        {**found.versions, **versions},
        (*found.earlier, FrozenDict(changed)) if changed else found.earlier,
    )
    return file, ended


def setting_differences(then: Mapping[str, Any], now: Mapping[str, Any]) -> Iterator[str]:
    """What is set otherwise, in words."""
    for name in sorted({*then, *now}):
        if then.get(name) != now.get(name):
            yield f"{name} is {now.get(name, 'left out')} and was {then.get(name, 'left out')}"


def _differences(there: Experiment, asked: Experiment, ended: Collection[RunKey]) -> Iterator[str]:
    """Why runs that ended are no runs of what is asked now, in words; more seeds, methods or problems are no reason.

    What has no run that ended may have changed.
    """
    if there.name != asked.name:
        yield f"its name is {there.name!r}, not {asked.name!r}"
    methods, problems = {key.method for key in ended}, {key.problem for key in ended}
    for before, now in _pairs(there.methods, asked.methods, methods):
        for difference in setting_differences(before.settings, now.settings):
            yield f"of its method {now.name!r} {difference}"
    for was, is_now in _pairs(there.problems, asked.problems, problems):
        for difference in setting_differences(_settings(was), _settings(is_now)):
            yield f"of its problem {is_now.name!r} {difference}"
    for was in there.problems:
        for is_now in asked.problems if was.name in problems else ():
            if _settings(was) == _settings(is_now) and was not in asked.problems:  # it would count twice in means
                yield f"its problem {was.name!r} is called {is_now.name!r} now"


def _pairs(there: Iterable[N], asked: Iterable[N], used: Collection[str]) -> Iterator[tuple[N, N]]:
    """What has runs and is asked again."""
    known = {item.name: item for item in there if item.name in used}
    return ((known[item.name], item) for item in asked if item.name in known)


def _settings(problem: ProblemFamily) -> Mapping[str, str]:
    return {"domain": problem.domain, "setting": problem.setting, **problem.options}


def _version_differences(there: Mapping[str, str], here: Mapping[str, str]) -> Mapping[str, str]:
    """The versions there that are others here; what only one of them knows is not compared."""
    return {name: there[name] for name in sorted(there.keys() & here.keys()) if there[name] != here[name]}


def _joined(there: Experiment, asked: Experiment, ended: Collection[RunKey]) -> Experiment:
    """What is asked now, with everything from before that has runs."""
    methods, problems = {key.method for key in ended}, {key.problem for key in ended}
    return replace(
        asked,
        seeds=tuple(sorted({*asked.seeds, *(key.seed for key in ended)})),
        methods=_with(asked.methods, there.methods, methods),
        problems=_with(asked.problems, there.problems, problems),
    )


def _with(asked: Sequence[N], there: Sequence[N], used: Collection[str]) -> tuple[N, ...]:
    names = {item.name for item in asked}
    return (*asked, *(item for item in there if item.name in used and item.name not in names))
