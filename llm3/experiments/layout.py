"""How the tables of an experiment are laid out, and what others published in the same places."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass

from llm3.types import FrozenDict

MEASURES = {
    "success": "%SR",
    "llm_calls": "#LM",
    "motion_calls": "#MP",
    "motion_calls_with_reused": "#MP with reused",
    "iterations": "iterations",
    "tokens": "tokens",
    "seconds": "seconds",
}
"""What is measured of a run, and the head of its column."""


@dataclass(frozen=True)
class Column:
    """The place of one problem in a table."""

    title: str
    problem: str


@dataclass(frozen=True)
class Group:
    """Columns under one head."""

    title: str
    columns: tuple[Column, ...]


@dataclass(frozen=True)
class Layout:
    """A table: a row for each method, and in each column the same measures of one problem, which may be there twice."""

    title: str
    measures: tuple[str, ...]
    """Keys of `MEASURES`."""
    groups: tuple[Group, ...]

    def __post_init__(self) -> None:
        check_measures(self.measures)
        for what, there in (("measure", self.measures), ("group", self.groups)):
            if not there:
                raise ValueError(f"the layout {self.title!r} needs at least one {what}")


@dataclass(frozen=True)
class Published:
    """Figures of other people for the same table."""

    source: str
    """Where they stand, in a line."""
    measures: tuple[str, ...]
    """What the numbers of a place are, in their order."""
    figures: Mapping[str, Mapping[str, tuple[float, ...]]]
    """By the row of a method and the name of a problem; success in percent."""
    label: str = "published"
    """What tables call their rows, such as ``the paper``."""

    def __post_init__(self) -> None:
        check_measures(self.measures)
        plain = {row: FrozenDict({p: tuple(f) for p, f in places.items()}) for row, places in self.figures.items()}
        object.__setattr__(self, "figures", FrozenDict(plain))
        for row, places in plain.items():
            for problem, numbers in places.items():
                if len(numbers) != len(self.measures):
                    raise ValueError(
                        f"the figures of {row!r} on {problem!r} must be {len(self.measures)} numbers, "
                        f"{', '.join(self.measures)}, not {len(numbers)}"
                    )

    def of(self, row: str, problem: str) -> Mapping[str, float]:
        """The figures of one place by their measures; empty where nothing was published."""
        return dict(zip(self.measures, self.figures.get(row, {}).get(problem, ()), strict=False))


def check_measures(names: tuple[str, ...]) -> None:
    """Refuse what is none of the `MEASURES`."""
    for name in names:
        if name not in MEASURES:
            raise ValueError(f"unknown measure {name!r}: {', '.join(MEASURES)}")
