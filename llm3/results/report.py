"""What is printed of summaries, in its order."""

from __future__ import annotations

from collections.abc import Iterator, Sequence

from llm3.results.budget_tables import budget_tables
from llm3.results.detail_tables import detail_table, difference_table
from llm3.results.layout_tables import layout_tables
from llm3.results.remarks import remarks, remarks_between
from llm3.results.summary import Summary
from llm3.results.table import Section, Table, one_line


def report(summaries: Sequence[Summary], seconds: bool = True) -> Iterator[Section]:
    """A section for each experiment and, for each but the first, one that compares it with the first.

    Args:
        summaries: Of one or more experiments.
        seconds: Whether to print what depends on the machine.
    """
    several = len(summaries) > 1
    for summary in summaries:
        experiment = summary.record.experiment
        title = one_line(experiment.title or experiment.name)
        if several:
            title = f"{one_line(str(summary.record.folder))}: {title}"
        yield Section(title, tuple(_content(summary, seconds)))
    for summary in summaries[1:]:
        here, there = (one_line(str(s.record.folder)) for s in (summary, summaries[0]))
        met = _problems(summary) & _problems(summaries[0])
        between = difference_table("Paired differences", [found for found in summary.since if found.problem in met])
        notes = tuple(remarks_between(summary.record, summaries[0].record))
        first = between if summary.since else "They have no method and problem in common."
        yield Section(f"{here} minus {there}", (first, *notes))


def _problems(summary: Summary) -> set[str | None]:
    """The problems that have rows, and None for all of them together."""
    return {None, *(problem.name for problem in summary.record.begun)}


def _content(summary: Summary, seconds: bool) -> Iterator[Table | str]:
    cells = {(cell.method, cell.problem): cell for cell in summary.cells}
    yield from layout_tables(summary.record.experiment, cells, seconds)
    begun = {key.method for key in summary.record.runs}
    shown = _problems(summary)
    ours = [cell for cell in summary.cells if cell.method in begun and cell.problem in shown]
    yield detail_table(ours, seconds)
    yield from budget_tables(summary.record.experiment.budgets, ours, seconds)
    differences = [found for found in summary.differences if found.method in begun and found.problem in shown]
    if differences:
        yield difference_table("Paired differences between the methods", differences)
    yield from remarks(summary.record, summary.cells)
