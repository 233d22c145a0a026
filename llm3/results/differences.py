"""Two methods on the same problems with the same seeds."""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass

import numpy as np

from llm3.experiments import Experiment, ExperimentRecord, RunKey, RunLine
from llm3.results.estimates import Estimate
from llm3.results.means import mean_estimates
from llm3.results.measures import is_attempt, values
from llm3.results.proportions import paired_share_difference
from llm3.results.sign_flips import sign_flip_test
from llm3.types import FrozenDict

COMPARED = ("success", "llm_calls", "motion_calls")

Pair = tuple[RunLine, RunLine]


@dataclass(frozen=True)
class Comparison:
    """A mean difference, and how likely one so large is by chance."""

    estimate: Estimate
    p: float
    """Of a two-sided exact test; not corrected for the number of comparisons."""


@dataclass(frozen=True)
class Difference:
    """How much more one method has than another, over the runs that both have."""

    method: str
    against: str
    problem: str | None
    """None for all problems together."""
    pairs: int
    comparisons: Mapping[str, Comparison]
    """By measure; none without pairs."""


def within(record: ExperimentRecord) -> Iterator[Difference]:
    """Every method against the first one that has runs."""
    begun = {key.method for key, run in record.runs.items() if is_attempt(run)}
    methods = record.experiment.methods
    first = next((method for method in methods if method.name in begun), methods[0])
    others = [method for method in methods if method is not first]
    problems = [problem.name for problem in record.experiment.problems]
    for method in others:
        yield from _differences((record, method.name), (record, first.name), problems)


def between(later: ExperimentRecord, first: ExperimentRecord) -> Iterator[Difference]:
    """Every method of a later experiment against the same one of an earlier one."""
    problems = common_problems(later.experiment, first.experiment)
    for method, other in common_methods(later.experiment, first.experiment):
        yield from _differences((later, method), (first, other), problems)


def common_problems(one: Experiment, other: Experiment) -> list[str]:
    """The names of the problems that both have, and mean the same by."""
    return [problem.name for problem in one.problems if problem in other.problems]


def common_methods(one: Experiment, other: Experiment) -> Iterator[tuple[str, str]]:
    """The methods that both have: of the same name or else, such as with another model, the only ones of their row."""
    names = {method.name for method in other.methods}
    for method in one.methods:
        if method.name in names:
            yield method.name, method.name
            continue
        here, there = ([m.name for m in e.methods if m.row == method.row] for e in (one, other))
        if len(here) == len(there) == 1:
            yield method.name, there[0]


def _differences(
    one: tuple[ExperimentRecord, str], other: tuple[ExperimentRecord, str], problems: Sequence[str]
) -> Iterator[Difference]:
    pairs = {problem: list(_pairs(one, other, problem)) for problem in problems}
    for problem, found in pairs.items():
        yield _difference(one[1], other[1], problem, found)
    if len(problems) > 1:
        yield _difference(one[1], other[1], None, [pair for found in pairs.values() for pair in found])


def _pairs(one: tuple[ExperimentRecord, str], other: tuple[ExperimentRecord, str], problem: str) -> Iterator[Pair]:
    for seed in one[0].experiment.seeds:
        run = one[0].runs.get(RunKey(one[1], problem, seed))
        against = other[0].runs.get(RunKey(other[1], problem, seed))
        if run and against and is_attempt(run) and is_attempt(against):
            yield run, against


def _difference(method: str, against: str, problem: str | None, pairs: Sequence[Pair]) -> Difference:
    if not pairs:
        return Difference(method, against, problem, 0, FrozenDict())
    more = values((pair[0] for pair in pairs), COMPARED) - values((pair[1] for pair in pairs), COMPARED)
    solved = more[:, 0]
    success = paired_share_difference(int(np.sum(solved > 0)), int(np.sum(solved < 0)), len(pairs))
    estimates = (success, *mean_estimates(more[:, 1:]))
    p_values = (sign_flip_test(column) for column in more.astype(int).T)
    found = zip(COMPARED, map(Comparison, estimates, p_values), strict=True)
    return Difference(method, against, problem, len(pairs), FrozenDict(dict(found)))
