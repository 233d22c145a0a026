"""Whether an experiment may go on in a folder, and what the folder holds then."""

from __future__ import annotations

from collections.abc import Collection, Iterable, Iterator, Mapping
from dataclasses import replace
from typing import Protocol, TypeVar

from llm3.experiments.experiment import Experiment, RunKey
from llm3.jsonio import dumps


class Named(Protocol):
    """A method or a problem."""

    @property
    def name(self) -> str:
        """What tables call it."""


N = TypeVar("N", bound=Named)


def differences(there: Experiment, asked: Experiment, ended: Collection[RunKey]) -> Iterator[str]:
    """Why runs that ended are no runs of what is asked now, in words; more seeds, methods or problems are no reason.

    Args:
        there: What was asked before.
        asked: What is asked now.
        ended: The runs that ended. What has none may have changed.
    """
    if there.name != asked.name:
        yield f"its name is {there.name!r}, not {asked.name!r}"
    yield from _changed("method", there.methods, asked.methods, {key.method for key in ended})
    yield from _changed("problem", there.problems, asked.problems, {key.problem for key in ended})


def version_differences(there: Mapping[str, str], here: Mapping[str, str]) -> Mapping[str, str]:
    """The versions there that are others here; what only one of them knows is not compared."""
    return {name: there[name] for name in sorted(there.keys() & here.keys()) if there[name] != here[name]}


def joined(there: Experiment, asked: Experiment, ended: Collection[RunKey]) -> Experiment:
    """What is asked now, with everything from before that has runs."""
    methods, problems = {key.method for key in ended}, {key.problem for key in ended}
    return replace(
        asked,
        seeds=tuple(sorted({*asked.seeds, *(key.seed for key in ended)})),
        methods=_with(asked.methods, there.methods, methods),
        problems=_with(asked.problems, there.problems, problems),
    )


def _changed(what: str, there: Iterable[Named], asked: Iterable[Named], used: Collection[str]) -> Iterator[str]:
    known = {item.name: item for item in there}
    for item in asked:
        if item.name in known and item.name in used and dumps(known[item.name]) != dumps(item):
            yield f"its {what} {item.name!r} has other settings"


def _with(asked: tuple[N, ...], there: tuple[N, ...], used: Collection[str]) -> tuple[N, ...]:
    names = {item.name for item in asked}
    return (*asked, *(item for item in there if item.name in used and item.name not in names))
