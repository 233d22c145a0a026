"""Whether an experiment may go on in a folder, and what the folder holds then."""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Mapping, Sequence
from dataclasses import replace
from typing import Protocol, TypeVar

from llm3.errors import UsageError
from llm3.experiments.experiment import Experiment
from llm3.jsonio import dumps


class Named(Protocol):
    """A method or a problem."""

    @property
    def name(self) -> str:
        """What tables call it."""


N = TypeVar("N", bound=Named)
SHOWN = 5
"""Longer lists are told by their ends."""


def differences(there: Experiment, asked: Experiment) -> Iterator[str]:
    """What results depend on and is not the same, in words."""
    if there.name != asked.name:
        yield f"the name is {there.name!r}, not {asked.name!r}"
    for what, found, wanted in (
        ("seeds", there.seeds, asked.seeds),
        ("methods", _names(there.methods), _names(asked.methods)),
        ("problems", _names(there.problems), _names(asked.problems)),
    ):
        if found != wanted:
            yield f"the {what} are {_short(found)}, not {_short(wanted)}"
    yield from _other_settings(there, asked)


def version_differences(there: Mapping[str, str], here: Mapping[str, str]) -> Iterator[str]:
    """Which versions are not the same, in words."""
    for name in sorted({*there, *here}):
        if there.get(name) != here.get(name):
            yield f"{name} was {there.get(name, 'not there')}, and is {here.get(name, 'not there')}"


def joined(there: Experiment, asked: Experiment) -> Experiment:
    """Both in one: the methods, problems and seeds of either.

    Raises:
        UsageError: Something of the same name is not the same in both.
    """
    for difference in _other_settings(there, asked):
        raise UsageError(f"two experiments cannot be joined: {difference}.")
    return replace(
        asked,
        seeds=tuple(sorted({*there.seeds, *asked.seeds})),
        methods=_union(there.methods, asked.methods),
        problems=_union(there.problems, asked.problems),
    )


def _other_settings(there: Experiment, asked: Experiment) -> Iterator[str]:
    yield from _changed("method", there.methods, asked.methods)
    yield from _changed("problem", there.problems, asked.problems)


def _changed(what: str, there: Iterable[Named], asked: Iterable[Named]) -> Iterator[str]:
    known = {item.name: item for item in there}
    for item in asked:
        if item.name in known and dumps(known[item.name]) != dumps(item):
            yield f"the {what} {item.name!r} has other settings"


def _union(there: tuple[N, ...], asked: tuple[N, ...]) -> tuple[N, ...]:
    return tuple({item.name: item for item in (*there, *asked)}.values())


def _names(items: Iterable[Named]) -> tuple[str, ...]:
    return tuple(item.name for item in items)


def _short(values: Sequence[object]) -> str:
    told = [str(value) for value in values]
    return ", ".join(told if len(told) <= SHOWN else [*told[: SHOWN - 2], "…", told[-1]])
