"""A figure to draw on, with matplotlib's own objects and none of its global state."""

from __future__ import annotations

from importlib.util import find_spec
from math import ceil
from pathlib import Path
from typing import TYPE_CHECKING, Literal

from llm3.errors import LLM3Error, MissingDependency
from llm3.results.table import one_line

if TYPE_CHECKING:
    from matplotlib.axes import Axes
    from matplotlib.figure import Figure

Dash = Literal["-", "--", "-.", ":"]
COLORS = ("#0072B2", "#E69F00", "#009E73", "#CC79A7", "#D55E00", "#56B4E9", "#000000", "#F0E442")
"""Those of Okabe and Ito (2008), which colour-blind people can tell apart."""
DASHES: tuple[Dash, ...] = ("-", "--", "-.", ":")
SMALL = 7
"""Points: what can still be read in a column of a paper."""
DOTS_PER_INCH = 200


def check_matplotlib() -> None:
    """Refuse to draw without matplotlib.

    Raises:
        MissingDependency: It is not installed.
    """
    if find_spec("matplotlib") is None:
        raise MissingDependency("figures need matplotlib, which is not installed: pip install 'llm3[plot]'.")


def color(index: int) -> str:
    """One of the palette; a ninth thing has the color of the first."""
    return COLORS[index % len(COLORS)]


def dash(index: int) -> Dash:
    """A style of line, which tells nine and more lines apart that share colors, and all in black and white."""
    return DASHES[(index + index // len(COLORS)) % len(DASHES)]


def label(text: str) -> str:
    """A text as it stands: to matplotlib, dollars mean formulas, and a first underscore that nothing is shown."""
    plain = one_line(text).replace("$", r"\$")
    return f" {plain}" if plain.startswith("_") else plain


def panels(rows: int, columns: int, width: float = 2.3, height: float = 1.9) -> tuple[Figure, list[list[Axes]]]:
    """A figure of equal panels.

    Args:
        rows: Of panels.
        columns: Of panels.
        width: Of one panel, in inches.
        height: Of one panel, in inches.
    """
    from matplotlib.backends.backend_agg import FigureCanvasAgg
    from matplotlib.figure import Figure

    figure = Figure(figsize=(max(3.4, width * columns), height * rows + 0.5), layout="constrained")
    FigureCanvasAgg(figure)
    axes = figure.subplots(rows, columns, squeeze=False).tolist()
    for one in (axis for row in axes for axis in row):
        one.tick_params(labelsize=SMALL)
        one.spines[["top", "right"]].set_visible(False)
    return figure, axes


def grid(count: int, widest: int = 3) -> tuple[int, int]:
    """Rows and columns for so many panels."""
    columns = min(count, widest)
    return ceil(count / columns), columns


def save(figure: Figure, path: Path) -> Path:
    """Write a PNG file; one that is there is replaced.

    Raises:
        LLM3Error: It cannot be written.
    """
    try:
        path.parent.mkdir(parents=True, exist_ok=True)
        figure.savefig(path, dpi=DOTS_PER_INCH, metadata={"Software": None})
    except OSError as error:
        raise LLM3Error(f"the figure '{path}' cannot be written: {error.strerror or error}.") from error
    return path
