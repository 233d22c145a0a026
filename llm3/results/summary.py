"""An experiment's results in figures."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

from llm3.experiments import ExperimentRecord
from llm3.results import differences as compare
from llm3.results.cells import Cell, cells
from llm3.results.differences import Difference


@dataclass(frozen=True)
class Summary:
    """What is printed of an experiment."""

    record: ExperimentRecord
    cells: tuple[Cell, ...]
    """By method and problem, each method's pooled one last."""
    differences: tuple[Difference, ...]
    """Every method against the first one."""
    since: tuple[Difference, ...] = ()
    """Every method against the same one of another experiment, if there is one to compare with."""


def summarize(records: Sequence[ExperimentRecord], seconds: bool = True) -> tuple[Summary, ...]:
    """The figures of one or more experiments; every later one is compared with the first.

    The same results give the same figures: what the intervals draw at random depends on how many there are alone.

    Args:
        records: What `llm3.experiments.read_experiment_folder` read.
        seconds: Whether to measure what depends on the machine.
    """
    return tuple(
        Summary(
            record,
            tuple(cells(record, seconds)),
            tuple(compare.within(record)),
            tuple(compare.between(record, records[0])) if index else (),
        )
        for index, record in enumerate(records)
    )
