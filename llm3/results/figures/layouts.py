"""The layouts that runs tried, on top of one another."""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from pathlib import Path
from typing import TYPE_CHECKING

from llm3.errors import LLM3Error
from llm3.experiments import ExperimentRecord, RunKey, record_folder
from llm3.registry import Registry
from llm3.results.figures.canvas import SMALL, color, label, panels, save
from llm3.results.figures.tried import Tried, tried_layouts
from llm3.results.summary import Summary
from llm3.results.table import one_line
from llm3.types import Shape

if TYPE_CHECKING:
    from matplotlib.axes import Axes
    from matplotlib.figure import Figure

MARGIN = 0.02
"""Metres around what is shown."""
LIGHT = 0.9
"""A colour of which no part is less than this does not show on paper."""
UNKNOWN = "0.5"
"""The colour of what was not there at the start."""


def draw_layouts(summary: Summary, folder: Path, registry: Registry) -> Iterator[Path | str]:
    """A panel for each problem and method, of the first seed that has records; or sentences that say why not."""
    record = summary.record
    folders = _recorded(record)
    if not folders:
        yield f"'{record.folder}' holds no records of its runs: the layouts that they tried are not drawn."
        return
    found: dict[RunKey, Tried] = {}
    for key, where in folders.items():
        try:
            tried = tried_layouts(registry, where)
        except LLM3Error as error:
            yield f"the layouts of {one_line(str(key))} are not drawn: {error}"
            continue
        if tried is None:
            yield f"the layouts of {one_line(str(key))} are not drawn: its domain has no top view."
        else:
            found[key] = tried
    if found:
        yield save(_figure(record, found), folder / f"layouts-of-seed-{next(iter(found)).seed}.png")


def _recorded(record: ExperimentRecord) -> Mapping[RunKey, Path]:
    """The folders of all records of one seed."""
    experiment = record.experiment
    for seed in experiment.seeds:
        keys = [RunKey(m.name, p.name, seed) for p in experiment.problems for m in experiment.methods]
        folders = {key: record.folder / record_folder(key) for key in keys}
        if any((where / "run.json").exists() for where in folders.values()):
            return {key: where for key, where in folders.items() if (where / "run.json").exists()}
    return {}


def _figure(record: ExperimentRecord, found: Mapping[RunKey, Tried]) -> Figure:
    from matplotlib.patches import Patch

    problems = [problem for problem in record.experiment.problems if problem.name in {key.problem for key in found}]
    methods = [method for method in record.experiment.methods if method.name in {key.method for key in found}]
    seed = next(iter(found)).seed
    figure, axes = panels(len(problems), len(methods), 1.9, 1.9)
    names = sorted({shape.name for tried in found.values() for shape in tried.start if not shape.fixed})
    colors = colors_of(names)
    for problem, row in zip(problems, axes, strict=True):
        for method, axis in zip(methods, row, strict=True):
            tried = found.get(RunKey(method.name, problem.name, seed))
            _panel(axis, tried, colors)
            ending = "no record" if tried is None else f"{len(tried.attempts)} tried{', solved' * tried.solved}"
            axis.set_title(f"{label(problem.name)}, {label(method.name)}\n{ending}", fontsize=SMALL)
    handles = [Patch(color=colors[name], label=label(name)) for name in names]
    figure.legend(handles=handles, loc="outside lower center", ncols=4, fontsize=SMALL, frameon=False)
    return figure


def colors_of(names: Sequence[str]) -> Mapping[str, str]:
    """The colours of objects: that with which a name begins, as of ``red_box``, or else one of the palette.

    What is as light as the paper gets one of the palette, too.
    """
    from matplotlib.colors import CSS4_COLORS, to_rgb

    own = {name: name.partition("_")[0] for name in names}
    own = {name: first for name, first in own.items() if first in CSS4_COLORS and min(to_rgb(first)) < LIGHT}
    rest = [name for name in names if name not in own]
    return {**own, **{name: color(index) for index, name in enumerate(rest)}}


def _panel(axis: Axes, tried: Tried | None, colors: Mapping[str, str]) -> None:
    if tried is None:
        axis.set_axis_off()
        return
    axis.set_aspect("equal")
    for shape in tried.start:
        _outline(axis, shape, "0.4", 1.0 if shape.fixed else 0.6, "-" if shape.fixed else ":")
    shapes = list(dict.fromkeys(shape for attempt in tried.attempts for shape in attempt))  # each place once
    _fill(axis, shapes, colors, max(0.06, min(0.5, 1.5 * len(colors) / max(1, len(shapes)))))
    for shape in tried.attempts[-1] if tried.attempts else ():
        _outline(axis, shape, colors.get(shape.name, UNKNOWN), 1.0, "-")
    _look_at(axis, [*(shape for shape in tried.start if shape.fixed), *shapes])
    axis.set_xlabel("x / m", fontsize=SMALL)
    axis.set_ylabel("y / m", fontsize=SMALL)


def _look_at(axis: Axes, shapes: Sequence[Shape]) -> None:
    """Show these shapes, and what else is near."""
    for set_limits, values in (
        (axis.set_xlim, [x for shape in shapes for x, _ in shape.corners]),
        (axis.set_ylim, [y for shape in shapes for _, y in shape.corners]),
    ):
        if values:
            set_limits(min(values) - MARGIN, max(values) + MARGIN)


def _fill(axis: Axes, shapes: Sequence[Shape], colors: Mapping[str, str], alpha: float) -> None:
    from matplotlib.collections import PolyCollection

    faces = [colors.get(shape.name, UNKNOWN) for shape in shapes]
    axis.add_collection(PolyCollection([s.corners for s in shapes], facecolors=faces, alpha=alpha, linewidths=0))


def _outline(axis: Axes, shape: Shape, color: str, width: float, style: str) -> None:
    closed = [*shape.corners, shape.corners[0]]
    axis.plot(*zip(*closed, strict=True), color=color, linewidth=width, linestyle=style)
