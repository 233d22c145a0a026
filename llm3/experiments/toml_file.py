"""Experiments as people write them: TOML files, from which methods and problems are spread out."""

from __future__ import annotations

import re
import sys
from collections.abc import Iterator, Mapping
from dataclasses import dataclass, field, fields
from itertools import product
from math import isfinite
from typing import Any

from llm3.assembly import RunConfig
from llm3.assembly.config import LOOP, OF_A_MODEL
from llm3.errors import InputError, LLM3Error, UnknownName
from llm3.experiments.budgets import Budgets
from llm3.experiments.experiment import Experiment, Method, ProblemFamily
from llm3.experiments.layout import Layout, Published
from llm3.jsonio import dumps, loads
from llm3.types import FrozenDict

if sys.version_info >= (3, 11):
    import tomllib
else:
    import tomli as tomllib

OF_PROBLEM = ("domain", "setting", "seed", "options")
"""Fields of a RunConfig that a problem and a seed decide."""
METHOD_FIELDS = tuple(f.name for f in fields(RunConfig) if f.name not in OF_PROBLEM)
"""Fields of a RunConfig that a method may set."""
LARGEST = 100_000
"""Attempts of an experiment; more are a slip of the pen."""
LARGEST_SEED = 2**63 - 1 - LARGEST
"""What every reader of a record can hold as a whole number, the last of all seeds included."""


@dataclass(frozen=True)
class ProblemTable:
    """One `[[problems]]`."""

    domain: str
    setting: str | tuple[str, ...]
    """Several stand for as many problems."""
    name: str | None = None
    """What tables call it; the setting, if it is left out."""
    options: Mapping[str, str | int | float] = field(default_factory=FrozenDict)
    """A number is taken as if it were written in quotes."""


@dataclass(frozen=True)
class ExperimentTable:
    """The whole file, as it is written."""

    name: str
    problems: tuple[ProblemTable, ...]
    methods: tuple[Mapping[str, Any], ...]
    title: str = ""
    attempts: int = 10
    first_seed: int = 0
    run: Mapping[str, Any] = field(default_factory=FrozenDict)
    """What all methods have in common."""
    layouts: tuple[Layout, ...] = ()
    published: tuple[Published, ...] = ()
    budgets: Budgets = field(default=Budgets())

    def __post_init__(self) -> None:
        if not 1 <= self.attempts <= LARGEST:
            raise ValueError(f"attempts must be from 1 to {LARGEST}, not {self.attempts}")
        if not 0 <= self.first_seed <= LARGEST_SEED:
            raise ValueError(f"first_seed must be from 0 to {LARGEST_SEED}, not {self.first_seed}")
        if not re.fullmatch(r"\w[\w.-]*", self.name):
            raise ValueError(f"the name of an experiment is made of letters, digits and _.-, not {self.name!r}")


def parse_toml(text: str, source: str) -> dict[str, Any]:
    """What the text says.

    Raises:
        InputError: It is no TOML.
    """
    try:
        return tomllib.loads(text)
    except (tomllib.TOMLDecodeError, RecursionError) as error:
        raise InputError(f"{source}: no TOML: {error}") from error


def experiment_of(written: Mapping[str, Any], source: str) -> Experiment:
    """The experiment that a TOML file describes.

    Args:
        written: What the file says, as dicts and lists.
        source: The file, for messages.

    Raises:
        InputError: A field is missing, unknown or of another type, or two methods have one name.
    """
    _refuse_infinite(written, source)
    try:
        text = dumps(written)
    except TypeError as error:
        raise InputError(f"{source}: {error}") from error
    table = loads(text, ExperimentTable, source)
    try:
        experiment = Experiment(
            table.name,
            table.title,
            tuple(range(table.first_seed, table.first_seed + table.attempts)),
            tuple(_problems(table)),
            tuple(_methods(table, source)),
            table.layouts,
            table.published,
            table.budgets,
        )
    except ValueError as error:
        raise InputError(f"{source}: {error}") from error
    for method in experiment.methods:  # types and values
        try:
            experiment.config(method, experiment.problems[0], experiment.seeds[0])
        except LLM3Error as error:
            raise InputError(f"{source}: {error}") from error
    return experiment


def _refuse_infinite(value: Any, source: str, where: str = "") -> None:
    """Refuse the numbers that TOML has and JSON has not; JSON's null would mean something else."""
    if isinstance(value, float) and not isfinite(value):
        raise InputError(f"{source}: {where} must be a finite number, not {value}")
    items = value.items() if isinstance(value, Mapping) else enumerate(value) if isinstance(value, list) else ()
    for key, child in items:
        _refuse_infinite(child, source, f"{where}.{key}" if where else str(key))


def _problems(table: ExperimentTable) -> Iterator[ProblemFamily]:
    domains = {problem.domain for problem in table.problems}
    for problem in table.problems:
        options = {key: str(value) for key, value in problem.options.items()}
        settings = (problem.setting,) if isinstance(problem.setting, str) else problem.setting
        for setting in settings:
            name = setting if len(domains) == 1 else f"{problem.domain}/{setting}"
            if problem.name is not None:
                name = problem.name if len(settings) == 1 else f"{problem.name} ({setting})"
            yield ProblemFamily(name, problem.domain, setting, options)


def _methods(table: ExperimentTable, source: str) -> Iterator[Method]:
    _refuse_unknown(table.run, "[run]", source)
    for number, entry in enumerate(table.methods, start=1):
        row = entry.get("name")
        if not isinstance(row, str) or not row.strip():
            raise InputError(f"{source}: method {number} needs a name")
        own = {key: value for key, value in entry.items() if key != "name"}
        _refuse_unknown(own, f"method {row!r}", source)
        apart = OF_A_MODEL if "llm" in own or own.get("solver", LOOP) != LOOP else ()
        common = {key: value for key, value in table.run.items() if key not in apart}
        yield from _spread(row, {"timing": "none", **common, **own}, source)


def _spread(row: str, settings: Mapping[str, Any], source: str) -> Iterator[Method]:
    """A method for each combination of the values of lists."""
    several = {key: value for key, value in settings.items() if isinstance(value, list | tuple)}
    for key, values in several.items():
        if not values:
            raise InputError(f"{source}: method {row!r} has an empty list of {key}")
    for values in product(*several.values()):
        told = [str(value) for value, others in zip(values, several.values(), strict=True) if len(others) > 1]
        name = f"{row} ({', '.join(told)})" if told else row
        yield Method(name, row, {**settings, **dict(zip(several, values, strict=True))})


def _refuse_unknown(given: Mapping[str, Any], owner: str, source: str) -> None:
    for key in given:
        if key not in METHOD_FIELDS:
            raise InputError(f"{source}: {UnknownName('field', key, METHOD_FIELDS, owner=owner)}")
