"""Summaries as comma-separated values: one figure a row."""

from __future__ import annotations

import csv
from collections.abc import Iterator, Sequence
from dataclasses import dataclass, fields
from io import StringIO

from llm3.results.differences import Difference
from llm3.results.estimates import Estimate
from llm3.results.measures import MACHINE
from llm3.results.summary import Summary
from llm3.results.table import one_line


@dataclass(frozen=True)
class Row:
    """One figure; its fields are the columns. What does not apply is empty."""

    kind: str
    """`count`, `value`, `within`, `difference` or `published`."""
    folder: str
    """Of the experiment; empty where only one is printed."""
    method: str
    problem: str
    """Empty for all problems together."""
    measure: str
    """Of `within`: what there is a budget of."""
    over: str = ""
    """`all` or `solved` runs, or `pairs`."""
    n: int | str = ""
    mean: float | str = ""
    """Shares are from 0 to 1."""
    low: float | str = ""
    high: float | str = ""
    p: float | str = ""
    other_folder: str = ""
    """Of a difference: what is subtracted."""
    other: str = ""
    """Of a difference: the method that is subtracted; of what was published: where."""
    budget: int | str = ""
    """Of `within`: the share is that of the runs that are solved within it."""


def as_csv(summaries: Sequence[Summary], seconds: bool = True) -> str:
    """All figures in long form, under one header."""
    out = StringIO()
    writer = csv.writer(out, lineterminator="\n")
    columns = [field.name for field in fields(Row)]
    writer.writerow(columns)
    folders = [one_line(str(s.record.folder)) if len(summaries) > 1 else "" for s in summaries]
    for summary, folder in zip(summaries, folders, strict=True):
        for row in _rows(summary, folder, folders[0], seconds):
            writer.writerow([_text(getattr(row, column)) for column in columns])
    return out.getvalue()


def _rows(summary: Summary, folder: str, first: str, seconds: bool) -> Iterator[Row]:
    for cell in summary.cells:
        method, problem = one_line(cell.method), one_line(cell.problem or "")
        counts = {
            "wanted": cell.wanted,
            "attempts": cell.attempts,
            "solved": cell.count("solved"),
            "errors": cell.count("error"),
            "crashed": cell.count("crashed"),
            "missing": cell.missing,
            "time limited": sum(run.time_limited for run in cell.ended),
        }
        for name, number in counts.items():
            yield Row("count", folder, method, problem, name, n=number)
        for (measure, over), estimate in cell.estimates.items():
            yield Row("value", folder, method, problem, measure, over, *_figures(estimate))
        for (measure, budget), estimate in cell.within.items():
            yield Row("within", folder, method, problem, measure, "all", *_figures(estimate), budget=budget)
    for difference in summary.differences:
        yield from _difference(difference, folder, folder)
    for difference in summary.since:
        yield from _difference(difference, folder, first)
    yield from _published(summary, folder, seconds)


def _difference(difference: Difference, folder: str, other_folder: str) -> Iterator[Row]:
    for measure, found in difference.comparisons.items():
        yield Row(
            "difference",
            folder,
            one_line(difference.method),
            one_line(difference.problem or ""),
            measure,
            "pairs",
            *_figures(found.estimate),
            p=found.p,
            other_folder=other_folder,
            other=one_line(difference.against),
        )


def _published(summary: Summary, folder: str, seconds: bool) -> Iterator[Row]:
    experiment = summary.record.experiment
    for published in experiment.published:
        source = one_line(published.source)
        for row in dict.fromkeys(method.row for method in experiment.methods):
            for problem in experiment.problems:
                for measure, value in published.of(row, problem.name).items():
                    if seconds or measure not in MACHINE:
                        mean = value / 100 if measure == "success" else value
                        yield Row(
                            "published", folder, one_line(row), one_line(problem.name), measure, mean=mean, other=source
                        )


def _figures(estimate: Estimate) -> tuple[int, float, float | str, float | str]:
    low, high = estimate.interval or ("", "")
    return estimate.n, estimate.mean, low, high


def _text(value: float | str) -> str:
    return f"{value:.6g}" if isinstance(value, float) else str(value)
