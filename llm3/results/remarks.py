"""What a reader of the tables must know besides."""

from __future__ import annotations

from collections.abc import Iterator, Sequence

from llm3.experiments import ExperimentRecord, setting_differences
from llm3.results.cells import Cell
from llm3.results.differences import common_problems
from llm3.results.measures import without_model
from llm3.results.table import one_line
from llm3.wording import counted

ENDINGS = {"crashed": "crashed", "error": "ended in an error"}


def remarks(record: ExperimentRecord, cells: Sequence[Cell]) -> Iterator[str]:
    """Runs that are not in the figures, and figures that are not what they seem."""
    begun = {key.method for key in record.runs}
    waiting = [repr(one_line(m.name)) for m in record.experiment.methods if m.name not in begun]
    cells = [cell for cell in cells if cell.problem is not None and cell.method in begun]
    for status, ended in ENDINGS.items():
        for cell in cells:
            runs = [run for run in cell.ended if run.status == status]
            if runs:
                yield (
                    f"{counted(len(runs), 'run')} of {_place(cell)} {ended}, and no figure has "
                    f"{'it' if len(runs) == 1 else 'them'} in it. The first one, seed {runs[0].key.seed}: "
                    f"{one_line(runs[0].error) or 'no reason is known'}"
                )
    met = {cell.problem for cell in cells if cell.ended}
    without = list(dict.fromkeys(one_line(str(cell.problem)) for cell in cells if cell.problem not in met))
    if without and met:
        yield f"No run on {', '.join(without)} has ended."
    for cell in cells:
        if cell.missing and (cell.problem in met or not met):
            yield f"{counted(cell.missing, 'run')} of {_place(cell)} {'is' if cell.missing == 1 else 'are'} missing."
    seeds = {run.key.seed for cell in cells for run in cell.ended}
    if seeds and max(seeds) - min(seeds) >= len(seeds):
        yield f"The figures are of all seeds together: {_ranges(seeds)}."
    if waiting:
        yield f"No run of {', '.join(waiting)} has ended."
    if record.strangers:
        yield f"{counted(record.strangers, 'line')} of runs.jsonl tell of runs that the experiment does not have."
    for versions in record.earlier:
        told = ", ".join(f"{one_line(name)} {one_line(version)}" for name, version in sorted(versions.items()))
        yield f"Some runs were made with other versions: {told}."
    for cell in cells:
        limited = sum(run.time_limited for run in cell.ended)
        if limited:
            yield (
                f"{counted(limited, 'run')} of {_place(cell)} met a limit of wall-clock time inside of a query, and "
                "may end otherwise when run again."
            )
    runs_of = {name: [run for cell in cells if cell.method == name for run in cell.ended] for name in begun}
    names = [method.name for method in record.experiment.methods if method.name in begun]
    alone = [repr(one_line(name)) for name in names if without_model(runs_of[name])]
    if alone:
        yield f"No language model answered in {', '.join(alone)}; #LM counts what stood in for one, if anything did."


def _ranges(seeds: set[int]) -> str:
    """Such as ``0 to 19, 1000``."""
    starts = sorted(seed for seed in seeds if seed - 1 not in seeds)
    ends = sorted(seed for seed in seeds if seed + 1 not in seeds)
    return ", ".join(str(low) if low == high else f"{low} to {high}" for low, high in zip(starts, ends, strict=True))


def remarks_between(later: ExperimentRecord, first: ExperimentRecord) -> Iterator[str]:
    """Why two experiments may differ, or cannot be compared."""
    for name in sorted(later.versions.keys() & first.versions.keys()):
        before, after = (record.versions[name] for record in (first, later))
        if before != after:
            yield f"Other versions: {one_line(name)} is {one_line(after)} and was {one_line(before)}."
    settings = {method.name: method.settings for method in first.experiment.methods}
    for method in later.experiment.methods:
        for difference in setting_differences(settings.get(method.name, method.settings), method.settings):
            yield f"Other settings of {one_line(method.name)}: {one_line(difference)}."
    names = {problem.name for problem in first.experiment.problems}
    alike = common_problems(later.experiment, first.experiment)
    for problem in later.experiment.problems:
        if problem.name in names and problem.name not in alike:
            yield f"{one_line(problem.name)} is not the same problem in both, and is not compared."


def _place(cell: Cell) -> str:
    return f"{one_line(cell.method)} on {one_line(cell.problem or '')}"
