"""How many runs are solved within a budget."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from pathlib import Path
from typing import TYPE_CHECKING

from llm3.experiments import Experiment, ExperimentRecord, RunLine
from llm3.results.cells import runs_of
from llm3.results.figures.canvas import SMALL, color, dash, grid, label, panels, save
from llm3.results.measures import MACHINE, VALUES, is_attempt
from llm3.results.summary import Summary
from llm3.results.within import UNITS, curve, is_spent

if TYPE_CHECKING:
    from matplotlib.axes import Axes
    from matplotlib.figure import Figure

SPARSE = (0, (1, 4))
WIDE = 50
"""Where the largest value is so many times the smallest, the axis is logarithmic."""


def draw_budgets(summary: Summary, folder: Path, seconds: bool) -> Iterator[Path | str]:
    """One figure for each kind of budget, or a sentence that says why it is not drawn."""
    record = summary.record
    attempts = [list(filter(is_attempt, runs_of(record, m.name, None))) for m in record.experiment.methods]
    for measure, unit in UNITS.items():
        if measure in MACHINE and not seconds:
            continue
        path = folder / f"success-by-{measure.replace('_', '-')}.png"
        if any(is_spent(runs, measure) for runs in attempts):
            drawn = [runs if is_spent(runs, measure) else [] for runs in attempts]
            yield _draw(record, drawn, measure, path)
        else:
            yield f"no method of '{record.folder}' spends {unit} that are known: {path.name} is not drawn."


def _draw(record: ExperimentRecord, attempts: Sequence[Sequence[RunLine]], measure: str, path: Path) -> Path:
    """The attempts are those of each method; a method without any has no curve."""
    experiment, problems = record.experiment, record.begun
    rows, columns = grid(len(problems))
    figure, axes = panels(rows, columns)
    flat = [axis for row in axes for axis in row]
    for axis in flat[len(problems) :]:
        axis.remove()
    for axis, problem in zip(flat, problems, strict=False):
        runs = [[run for run in ours if run.key.problem == problem.name] for ours in attempts]
        _panel(axis, runs, measure)
        if measure == "llm_calls":
            _published(axis, experiment, problem.name)
        axis.set_title(label(problem.name), fontsize=SMALL + 1)
        axis.set_xlabel(UNITS[measure], fontsize=SMALL)
        axis.set_ylabel("runs solved / %", fontsize=SMALL)
    _legend(figure, experiment, measure == "llm_calls" and any("success" in p.measures for p in experiment.published))
    return save(figure, path)


def _panel(axis: Axes, runs: Sequence[Sequence[RunLine]], measure: str) -> None:
    found = [VALUES[measure](run) for lines in runs for run in lines]
    last, smallest = max(found, default=1.0), min((x for x in found if x > 0), default=1.0)
    if last > WIDE * smallest:
        axis.set_xscale("log")
        axis.set_xlim(smallest / 1.5, last * 1.1)
    for index, lines in enumerate(runs):
        if not lines:
            continue
        x, shares = curve(lines, measure, last)
        low, high = ([100 * (share.interval or (0, 1))[end] for share in shares] for end in (0, 1))
        means = [100 * share.mean for share in shares]
        axis.step(x, means, where="post", color=color(index), linestyle=dash(index), linewidth=1.2)
        axis.fill_between(x, low, high, step="post", color=color(index), alpha=0.12, linewidth=0)
    axis.set_ylim(-2, 102)


def _published(axis: Axes, experiment: Experiment, problem: str) -> None:
    """What others reached in the end."""
    for index, method in enumerate(experiment.methods):
        for published in experiment.published:
            success = published.of(method.row, problem).get("success")
            if success is not None:
                axis.axhline(success, color=color(index), linestyle=SPARSE, linewidth=0.8)


def _legend(figure: Figure, experiment: Experiment, published: bool) -> None:
    from matplotlib.lines import Line2D

    handles = [
        Line2D([], [], color=color(index), linestyle=dash(index), linewidth=1.2, label=label(method.name))
        for index, method in enumerate(experiment.methods)
    ]
    if published:
        handles.append(Line2D([], [], color="0.4", linestyle=SPARSE, linewidth=0.8, label="published, in the end"))
    figure.legend(handles=handles, loc="outside lower center", ncols=2, fontsize=SMALL, frameon=False)
