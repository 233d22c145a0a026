"""What came of one method on one problem, or on all of them."""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass, field
from typing import Literal

from llm3.experiments import MEASURES, ExperimentRecord, RunKey, RunLine
from llm3.results.estimates import Estimate
from llm3.results.means import mean_estimates
from llm3.results.measures import MACHINE, is_attempt, is_known, values
from llm3.results.proportions import share_estimate
from llm3.results.within import is_spent, shares_within
from llm3.types import FrozenDict

Over = Literal["all", "solved"]
"""Over which runs a mean is taken; a run that its budget ended is among all, with what it had spent by then."""


@dataclass(frozen=True)
class Cell:
    """The runs of one method on one problem, and their figures."""

    method: str
    problem: str | None
    """None for all problems together."""
    wanted: int
    """How many runs the experiment asks for."""
    ended: tuple[RunLine, ...]
    estimates: Mapping[tuple[str, Over], Estimate]
    """By measure. There are none without runs, none over solved runs where none is solved, and none of what is not
    known."""
    within: Mapping[tuple[str, int], Estimate] = field(default_factory=FrozenDict)
    """The share of runs that are solved within each budget of the experiment, by measure; without runs there are none,
    and none where such a budget means nothing to the method."""

    @property
    def attempts(self) -> int:
        """Runs that were solved or not; the figures are theirs."""
        return sum(map(is_attempt, self.ended))

    @property
    def missing(self) -> int:
        """Runs that have not ended yet."""
        return self.wanted - len(self.ended)

    def count(self, status: str) -> int:
        """How many ended so."""
        return sum(run.status == status for run in self.ended)


def cells(record: ExperimentRecord, seconds: bool = True) -> Iterator[Cell]:
    """For each method one for each problem and, where there are several, one for all of them.

    Args:
        record: What is known of the experiment.
        seconds: Whether to measure what depends on the machine.
    """
    experiment = record.experiment
    problems: list[str | None] = [problem.name for problem in experiment.problems]
    if len(problems) > 1:
        problems.append(None)
    measures = tuple(measure for measure in MEASURES if seconds or measure not in MACHINE)
    for method in experiment.methods:
        budgets = _budgets(record, method.name, measures)
        for name in problems:
            ended = runs_of(record, method.name, name)
            wanted = len(experiment.seeds) * (len(problems) - 1 if name is None else 1)
            estimates = FrozenDict(_estimates(ended, measures))
            yield Cell(method.name, name, wanted, ended, estimates, FrozenDict(_within(ended, budgets)))


def runs_of(record: ExperimentRecord, method: str, problem: str | None) -> tuple[RunLine, ...]:
    """The runs of a method that ended, by problem and seed."""
    experiment = record.experiment
    names = [p.name for p in experiment.problems if problem in (None, p.name)]
    keys = (RunKey(method, name, seed) for name in names for seed in experiment.seeds)
    return tuple(record.runs[key] for key in keys if key in record.runs)


def _estimates(ended: Sequence[RunLine], measures: Sequence[str]) -> dict[tuple[str, Over], Estimate]:
    attempts = [run for run in ended if is_attempt(run)]
    solved = [run for run in attempts if run.solved]
    found: dict[tuple[str, Over], Estimate] = {}
    if attempts:
        found["success", "all"] = share_estimate(len(solved), len(attempts))
    over: Over
    for over, runs in (("all", attempts), ("solved", solved)):
        counted = [measure for measure in measures if measure != "success" and is_known(runs, measure)]
        if runs:
            estimates = mean_estimates(values(runs, counted))
            found.update({(measure, over): e for measure, e in zip(counted, estimates, strict=True)})
    return found


def _budgets(record: ExperimentRecord, method: str, measures: Sequence[str]) -> dict[str, tuple[int, ...]]:
    """The budgets of the experiment that mean something to a method, by measure."""
    attempts = list(filter(is_attempt, runs_of(record, method, None)))
    given = record.experiment.budgets.by_measure
    return {measure: given[measure] for measure in given if measure in measures and is_spent(attempts, measure)}


def _within(ended: Sequence[RunLine], budgets: Mapping[str, Sequence[int]]) -> dict[tuple[str, int], Estimate]:
    attempts = list(filter(is_attempt, ended))
    return {
        (measure, amount): share
        for measure, amounts in budgets.items()
        if attempts
        for amount, share in zip(amounts, shares_within(attempts, measure, amounts), strict=True)
    }
