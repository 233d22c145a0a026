"""The tables that tell how many runs are solved within a budget."""

from __future__ import annotations

from collections.abc import Iterator, Sequence

from llm3.experiments import Budgets
from llm3.results.cells import Cell
from llm3.results.estimates import LEVEL
from llm3.results.measures import MACHINE
from llm3.results.numbers import NOTHING, with_interval
from llm3.results.table import Table, one_line, problem_title
from llm3.results.within import UNITS


def budget_tables(budgets: Budgets, cells: Sequence[Cell], seconds: bool = True) -> Iterator[Table]:
    """One table for each kind of budget of which a method spends some, with a row a cell and a column a budget.

    Args:
        budgets: Those that the experiment names.
        cells: What came of each method on each problem.
        seconds: Whether to print what depends on the machine.
    """
    note = (
        f"%SR within so much, with Wilson's {100 * LEVEL:g} % intervals. A run that ended unsolved is unsolved within "
        f"every budget; {NOTHING} stands where the method spends nothing of the kind, or how much is not known."
    )
    spent = {measure for cell in cells for measure, _ in cell.within}
    wanted = {m: amounts for m, amounts in budgets.by_measure.items() if seconds or m not in MACHINE}
    shown = {m: amounts for m, amounts in wanted.items() if m in spent}
    for number, (measure, amounts) in enumerate(shown.items(), 1):
        heads = ("method", "problem", "runs", *map(str, amounts))
        rows = tuple(_row(cell, measure, amounts) for cell in cells)
        notes = (note,) if number == len(shown) else ()
        title = f"Solved within a budget of {UNITS[measure]}"
        yield Table(title, tuple((head,) for head in heads), rows, notes, names=2)


def _row(cell: Cell, measure: str, amounts: Sequence[int]) -> tuple[str, ...]:
    shares = (with_interval(cell.within.get((measure, amount)), "success") for amount in amounts)
    return one_line(cell.method), problem_title(cell.problem), f"{cell.attempts}/{cell.wanted}", *shares
