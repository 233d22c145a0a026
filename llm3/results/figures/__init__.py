"""The figures of an experiment; matplotlib draws them."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from pathlib import Path

from llm3.registry import Registry
from llm3.results.figures.budgets import draw_budgets
from llm3.results.figures.canvas import check_matplotlib
from llm3.results.figures.failures import draw_failures
from llm3.results.figures.layouts import draw_layouts
from llm3.results.summary import Summary

__all__ = ["check_matplotlib", "draw"]


def draw(summaries: Sequence[Summary], folder: Path, registry: Registry, seconds: bool = True) -> Iterator[str]:
    """Write all figures as PNG files; each experiment has a folder of its own where there are several.

    Args:
        summaries: Of one or more experiments.
        folder: Where to; it is made if it is not there, and what it holds of the same names is replaced.
        registry: Knows the domains, which draw the layouts.
        seconds: Whether to draw what depends on the machine.

    Yields:
        The path of each figure, or a sentence that says what is not drawn and why.

    Raises:
        MissingDependency: matplotlib is not installed.
        LLM3Error: A file cannot be written.
    """
    check_matplotlib()
    for number, summary in enumerate(summaries, 1):
        own = folder / f"{number}-{summary.record.folder.resolve().name}" if len(summaries) > 1 else folder
        yield from map(str, draw_budgets(summary, own, seconds))
        yield str(draw_failures(summary, own))
        yield from map(str, draw_layouts(summary, own, registry))
