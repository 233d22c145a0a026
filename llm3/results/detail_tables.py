"""The tables with intervals: of each method, and of the differences between two."""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Sequence
from typing import get_args

from llm3.experiments import MEASURES
from llm3.results.cells import Cell, Over
from llm3.results.differences import COMPARED, Difference
from llm3.results.estimates import LEVEL
from llm3.results.measures import MACHINE
from llm3.results.numbers import NOTHING, difference_with_interval, p_value, with_interval
from llm3.results.table import Table, one_line, problem_title


def detail_table(cells: Sequence[Cell], seconds: bool = True) -> Table:
    """Every measure of every method on every problem, over all runs and over solved ones."""
    measures = [measure for measure in MEASURES if seconds or measure not in MACHINE]
    heads = ("method", "problem", "mean over", "runs", *(MEASURES[measure] for measure in measures))
    rows = tuple(_row(cell, over, measures) for cell in cells for over in get_args(Over))
    notes = (
        f"In brackets: {100 * LEVEL:g} % intervals; Wilson's for %SR, bootstrap for all others, from six runs on. One "
        "without width comes of runs that are all alike, and says nothing of the next one.",
        "A run that its budget ended is no cheap one: the means over all runs have it with what it had spent by then, "
        "the means over solved runs leave it out.",
    )
    return Table("Every method", tuple((head,) for head in heads), rows, notes, names=3)


def _row(cell: Cell, over: Over, measures: Iterable[str]) -> tuple[str, ...]:
    runs = f"{cell.attempts}/{cell.wanted}" if over == "all" else str(cell.count("solved"))
    figures = (with_interval(cell.estimates.get((m, over)), m) for m in measures)
    return (one_line(cell.method), problem_title(cell.problem), f"{over} runs", runs, *figures)


def difference_table(title: str, differences: Sequence[Difference]) -> Table:
    """The paired differences."""
    heads = ["method", "minus", "problem", "pairs"]
    for measure in COMPARED:
        heads += [MEASURES[measure], "p"]
    notes = (
        "Over the seeds that both have. %SR in percentage points, with the intervals of Bonett and Price; the others "
        "with bootstrap intervals, from six pairs on.",
        "p: McNemar's exact test for %SR, sign-flip test for the others; two-sided, not corrected for the number of "
        "comparisons.",
    )
    rows = tuple(tuple(_difference_row(difference)) for difference in differences)
    return Table(title, tuple((head,) for head in heads), rows, notes, names=3)


def _difference_row(difference: Difference) -> Iterator[str]:
    yield one_line(difference.method)
    yield one_line(difference.against)
    yield problem_title(difference.problem)
    yield str(difference.pairs)
    for measure in COMPARED:
        found = difference.comparisons.get(measure)
        yield difference_with_interval(found.estimate, measure) if found else NOTHING
        yield p_value(found.p) if found else NOTHING
