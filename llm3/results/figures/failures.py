"""What attempts failed of."""

from __future__ import annotations

from pathlib import Path

from llm3.results.cells import Cell
from llm3.results.figures.canvas import SMALL, color, label, panels, save
from llm3.results.measures import is_attempt
from llm3.results.summary import Summary
from llm3.types import FailureKind

HATCHES = ("", "///", "...", "xxx", "\\\\\\", "ooo", "---")


def draw_failures(summary: Summary, folder: Path) -> Path:
    """A bar for each method, over all problems: the shares of the kinds of failure that ended attempts."""
    methods = summary.record.experiment.methods
    counts = [
        failures_per_run([c for c in summary.cells if c.method == method.name and c.problem is not None])
        for method in methods
    ]
    totals = [sum(found.values()) for found in counts]
    kinds = [kind.value for kind in FailureKind]
    kinds += sorted({kind for found in counts for kind in found} - set(kinds))
    figure, ((axis,),) = panels(1, 1, 4.6, 0.5 + 0.3 * len(methods))
    places = range(len(methods))
    left = [0.0] * len(methods)
    for index, kind in enumerate(kinds):
        widths = [100 * found.get(kind, 0.0) / (total or 1) for found, total in zip(counts, totals, strict=True)]
        if any(widths):
            hatch = HATCHES[index % len(HATCHES)]
            bars = axis.barh(places, widths, 0.7, left, color=color(index), label=label(kind))
            for bar in bars:
                bar.set(hatch=hatch, edgecolor="white", linewidth=0)
            left = [before + width for before, width in zip(left, widths, strict=True)]
    names = [f"{label(m.name)}\n{total:.1f} in a run" for m, total in zip(methods, totals, strict=True)]
    axis.set_yticks(places, names, fontsize=SMALL)
    axis.invert_yaxis()
    axis.set_xlabel("failed attempts / %", fontsize=SMALL)
    if any(left):
        figure.legend(loc="outside lower center", ncols=3, fontsize=SMALL, frameon=False)
    return save(figure, folder / "failures-by-kind.png")


def failures_per_run(cells: list[Cell]) -> dict[str, float]:
    """The mean number of attempts that each kind of failure ended."""
    runs = [run for cell in cells for run in cell.ended if is_attempt(run)]
    kinds = {kind for run in runs for kind in run.failures}
    return {kind: sum(run.failures.get(kind, 0) for run in runs) / len(runs) for kind in kinds}
