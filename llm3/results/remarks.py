"""What a reader of the tables must know besides."""

from __future__ import annotations

from collections.abc import Iterator, Sequence

from llm3.experiments import Experiment, ExperimentRecord
from llm3.results.cells import Cell
from llm3.results.differences import common_problems
from llm3.results.measures import without_model
from llm3.results.numbers import plural
from llm3.results.table import one_line

ENDINGS = {"crashed": "crashed", "error": "ended in an error"}


def remarks(experiment: Experiment, cells: Sequence[Cell]) -> Iterator[str]:
    """Runs that are not in the figures, and figures that are not what they seem."""
    cells = [cell for cell in cells if cell.problem is not None]
    for status, ended in ENDINGS.items():
        for cell in cells:
            runs = [run for run in cell.ended if run.status == status]
            if runs:
                yield (
                    f"{plural(len(runs), 'run')} of {_place(cell)} {ended}, and no figure has "
                    f"{'it' if len(runs) == 1 else 'them'} in it. The first one, seed {runs[0].key.seed}: "
                    f"{one_line(runs[0].error) or 'no reason is known'}"
                )
    for cell in cells:
        if cell.missing:
            yield f"{plural(cell.missing, 'run')} of {_place(cell)} {'is' if cell.missing == 1 else 'are'} missing."
    for cell in cells:
        limited = sum(run.time_limited for run in cell.ended)
        if limited:
            yield (
                f"{plural(limited, 'run')} of {_place(cell)} met a limit of wall-clock time inside of a query, and may "
                "end otherwise when run again."
            )
    methods = {m.name: [r for c in cells if c.method == m.name for r in c.ended] for m in experiment.methods}
    alone = [repr(one_line(name)) for name, runs in methods.items() if runs and without_model(runs)]
    if alone:
        yield f"No language model answered in {', '.join(alone)}: #LM counts iterations there."


def remarks_between(later: ExperimentRecord, first: ExperimentRecord) -> Iterator[str]:
    """Why two experiments may differ, or cannot be compared."""
    for name in sorted(later.versions.keys() | first.versions.keys()):
        before, after = (record.versions.get(name, "none") for record in (first, later))
        if before != after:
            yield f"Other versions: {one_line(name)} is {one_line(after)} and was {one_line(before)}."
    names = {problem.name for problem in first.experiment.problems}
    alike = common_problems(later.experiment, first.experiment)
    for problem in later.experiment.problems:
        if problem.name in names and problem.name not in alike:
            yield f"{one_line(problem.name)} is not the same problem in both, and is not compared."


def _place(cell: Cell) -> str:
    return f"{one_line(cell.method)} on {one_line(cell.problem or '')}"
