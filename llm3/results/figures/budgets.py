"""How many runs are solved within a budget."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from pathlib import Path
from typing import TYPE_CHECKING

from llm3.experiments import Experiment, RunLine
from llm3.results.figures.canvas import SMALL, color, dash, grid, label, panels, save
from llm3.results.measures import MACHINE, VALUES, is_attempt
from llm3.results.proportions import share_estimate
from llm3.results.summary import Summary

if TYPE_CHECKING:
    from matplotlib.axes import Axes
    from matplotlib.figure import Figure

BUDGETS = {"llm_calls": "model calls", "motion_calls": "motion calls", "seconds": "time / s"}
SPARSE = (0, (1, 4))
WIDE = 50
"""Where the largest value is so many times the smallest, the axis is logarithmic."""


def draw_budgets(summary: Summary, folder: Path, seconds: bool) -> Iterator[Path]:
    """One figure for each kind of budget."""
    for measure, unit in BUDGETS.items():
        if seconds or measure not in MACHINE:
            yield _draw(summary, measure, unit, folder / f"success-by-{measure.replace('_', '-')}.png")


def _draw(summary: Summary, measure: str, unit: str, path: Path) -> Path:
    experiment = summary.record.experiment
    problems = experiment.problems
    rows, columns = grid(len(problems))
    figure, axes = panels(rows, columns)
    flat = [axis for row in axes for axis in row]
    for axis in flat[len(problems) :]:
        axis.remove()
    for axis, problem in zip(flat, problems, strict=False):
        runs = {c.method: list(filter(is_attempt, c.ended)) for c in summary.cells if c.problem == problem.name}
        _panel(axis, runs, measure)
        if measure == "llm_calls":
            _published(axis, experiment, problem.name)
        axis.set_title(label(problem.name), fontsize=SMALL + 1)
        axis.set_xlabel(unit, fontsize=SMALL)
        axis.set_ylabel("runs solved / %", fontsize=SMALL)
    _legend(figure, experiment, measure == "llm_calls" and any("success" in p.measures for p in experiment.published))
    return save(figure, path)


def steps(runs: Sequence[RunLine], measure: str, last: float) -> tuple[list[float], list[float]]:
    """Where the share of runs that are solved within x rises, and to what; runs are solved or not, at least one."""
    solved = sorted(VALUES[measure](run) for run in runs if run.solved)
    shares = [(number + 1) / len(runs) for number in range(len(solved))]
    return [0.0, *solved, last], [0.0, *shares, shares[-1] if shares else 0.0]


def _panel(axis: Axes, runs: dict[str, list[RunLine]], measure: str) -> None:
    found = [VALUES[measure](run) for lines in runs.values() for run in lines]
    last, smallest = max(found, default=1.0), min((x for x in found if x > 0), default=1.0)
    if last > WIDE * smallest:
        axis.set_xscale("log")
        axis.set_xlim(smallest / 1.5, last * 1.1)
    for index, lines in enumerate(runs.values()):
        if not lines:
            continue
        x, shares = steps(lines, measure, last)
        bands = [share_estimate(round(share * len(lines)), len(lines)).interval or (0.0, 1.0) for share in shares]
        low, high = ([100 * band[end] for band in bands] for end in (0, 1))
        axis.step(x, [100 * s for s in shares], where="post", color=color(index), linestyle=dash(index), linewidth=1.2)
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
