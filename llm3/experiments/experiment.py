"""What an experiment consists of: methods that are tried on the same problems with the same seeds."""

from __future__ import annotations

from collections import Counter
from collections.abc import Iterator, Mapping
from dataclasses import dataclass, field, replace
from typing import Any

from llm3.assembly import RunConfig
from llm3.errors import UnknownName
from llm3.experiments.budgets import Budgets
from llm3.experiments.layout import Layout, Published
from llm3.jsonio import dumps, loads
from llm3.types import FrozenDict

LONGEST_NAME = 200


def check_name(what: str, name: str) -> None:
    """Refuse what cannot be printed in a table or be part of a file's name.

    Raises:
        ValueError: It cannot.
    """
    if not name.strip() or not name.isprintable() or len(name) > LONGEST_NAME:
        raise ValueError(
            f"the name of a {what} is a printable text of 1 to {LONGEST_NAME} characters, not {name[:LONGEST_NAME]!r}"
        )


@dataclass(frozen=True)
class ProblemFamily:
    """Problems of one kind, one for each seed."""

    name: str
    """What tables call it."""
    domain: str
    setting: str
    options: Mapping[str, str] = field(default_factory=FrozenDict)
    """Domain options that differ from their defaults."""

    def __post_init__(self) -> None:
        object.__setattr__(self, "options", FrozenDict(self.options))


@dataclass(frozen=True)
class Method:
    """A way to solve problems: a solver, a prompt strategy, a feedback level, a planner, a model and a budget."""

    name: str
    """What tables call it, and unique."""
    row: str
    """Its name without what tells it apart from others of the same row, such as the model."""
    settings: Mapping[str, Any]
    """Fields of a `RunConfig`; those that are not here have their defaults."""

    def __post_init__(self) -> None:
        object.__setattr__(self, "settings", FrozenDict(self.settings))


@dataclass(frozen=True)
class RunKey:
    """Which run of an experiment."""

    method: str
    problem: str
    seed: int

    def __str__(self) -> str:
        return f"{self.method} / {self.problem} / {self.seed}"


@dataclass(frozen=True)
class Job:
    """One run that an experiment needs."""

    key: RunKey
    config: RunConfig


@dataclass(frozen=True)
class Experiment:
    """Every method on every problem with every seed. The seed chooses the instance, so that methods are paired."""

    name: str
    title: str
    seeds: tuple[int, ...]
    problems: tuple[ProblemFamily, ...]
    methods: tuple[Method, ...]
    layouts: tuple[Layout, ...] = ()
    """How its tables are printed; empty for one column a problem."""
    published: tuple[Published, ...] = ()
    """Figures of other people, to be printed beside."""
    budgets: Budgets = field(default=Budgets())
    """For which tables tell how many runs are solved within them."""

    def __post_init__(self) -> None:
        for what, names in (
            ("seed", self.seeds),
            ("problem", [problem.name for problem in self.problems]),
            ("method", [method.name for method in self.methods]),
        ):
            if not names:
                raise ValueError(f"an experiment needs at least one {what}")
            twice = [name for name, count in Counter(names).items() if count > 1]
            if twice:
                raise ValueError(f"the {what} {twice[0]!r} is there twice")
        for what, name in self._names():
            check_name(what, name)
        self._check_places()

    def _names(self) -> Iterator[tuple[str, str]]:
        yield from (("problem", problem.name) for problem in self.problems)
        yield from (("method", name) for method in self.methods for name in (method.name, method.row))

    def _check_places(self) -> None:
        """Refuse tables with columns of what is not here."""
        known = [problem.name for problem in self.problems]
        for layout in self.layouts:
            for name in (column.problem for group in layout.groups for column in group.columns):
                if name not in known:
                    raise ValueError(
                        f"layout {layout.title!r} has a column of {name!r}, which is none of the problems: "
                        f"{', '.join(known)}"
                    )

    def __len__(self) -> int:
        return len(self.seeds) * len(self.problems) * len(self.methods)

    def config(self, method: Method, problem: ProblemFamily, seed: int) -> RunConfig:
        """What is asked of one run.

        Raises:
            InputError: The method's settings are no fields of a RunConfig, or have values of other types.
            UsageError: A value cannot be.
        """
        fields = {
            **method.settings,
            "domain": problem.domain,
            "setting": problem.setting,
            "seed": seed,
            "options": problem.options,
        }
        return loads(dumps(fields), RunConfig, f"method {method.name!r}")

    def jobs(self) -> Iterator[Job]:
        """All runs; those of one seed stand together, so that what is done when it is stopped can be compared."""
        for seed in self.seeds:
            for problem in self.problems:
                for method in self.methods:
                    config = self.config(method, problem, seed)
                    yield Job(RunKey(method.name, problem.name, seed), config)

    def only(self, methods: tuple[str, ...] = (), problems: tuple[str, ...] = ()) -> Experiment:
        """Some of its methods and problems, all where none is named, without its tables.

        Raises:
            UnknownName: It has none of this name.
        """
        owner = f"experiment {self.name!r}"
        for what, wanted, known in (
            ("method", methods, {name for m in self.methods for name in (m.name, m.row)}),
            ("problem", problems, {p.name for p in self.problems}),
        ):
            for name in wanted:
                if name not in known:
                    raise UnknownName(what, name, known, owner=owner)
        return replace(
            self,
            methods=tuple(m for m in self.methods if not methods or m.name in methods or m.row in methods),
            problems=tuple(p for p in self.problems if not problems or p.name in problems),
            layouts=(),
            published=(),
            budgets=Budgets(),
        )
