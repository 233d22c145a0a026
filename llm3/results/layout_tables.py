"""The tables of an experiment's own layouts, with what others published beside them."""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence

from llm3.experiments import MEASURES, Column, Experiment, Group, Layout, Method, Published
from llm3.results.cells import Cell
from llm3.results.measures import MACHINE
from llm3.results.numbers import NOTHING, figure
from llm3.results.table import Table, one_line

Cells = Mapping[tuple[str, str | None], Cell]
"""By the names of a method and a problem."""
Place = tuple[Group, Column]


def layout_tables(experiment: Experiment, cells: Cells, seconds: bool = True) -> Iterator[Table]:
    """One table for each layout."""
    for layout in experiment.layouts or (default_layout(experiment),):
        yield _table(experiment, layout, cells, seconds)


def default_layout(experiment: Experiment) -> Layout:
    """One column for each problem."""
    columns = tuple(Column(problem.name, problem.name) for problem in experiment.problems)
    return Layout("", ("success", "llm_calls", "motion_calls"), (Group("", columns),))


def _table(experiment: Experiment, layout: Layout, cells: Cells, seconds: bool) -> Table:
    measures = [measure for measure in layout.measures if seconds or measure not in MACHINE]
    places = [(group, column) for group in layout.groups for column in group.columns]
    heads = [("", "", "method")]
    heads += [(one_line(g.title), one_line(c.title), MEASURES[m]) for g, c in places for m in measures]
    empty = [level for level in range(2) if not any(head[level] for head in heads)]
    heads = [tuple(text for level, text in enumerate(head) if level not in empty) for head in heads]  # type: ignore[misc]  # fewer levels
    rows, notes = [], []
    sources = [published for published in experiment.published if _is_beside(published, experiment, places)]
    for index, method in enumerate(experiment.methods):
        rows.append((one_line(method.name), *_ours(method, places, measures, cells)))
        notes += [note for place in places if (note := _incomplete(method, place, cells))]
        following = experiment.methods[index + 1 : index + 2]
        if not (following and following[0].row == method.row):
            rows += list(_published(method.row, places, measures, sources))
    notes = list(dict.fromkeys(notes))
    notes += [f"{_source_name(number, sources)[2:]}: {one_line(s.source)}" for number, s in enumerate(sources, 1)]
    return Table(one_line(layout.title), tuple(heads), tuple(rows), tuple(notes))


def _ours(method: Method, places: Sequence[Place], measures: Sequence[str], cells: Cells) -> Iterator[str]:
    for _, column in places:
        cell = cells.get((method.name, column.problem))
        mark = "*" if cell and cell.attempts < cell.wanted else ""
        for measure in measures:
            estimate = cell.estimates.get((measure, "all")) if cell else None
            yield f"{figure(estimate.mean, measure)}{mark}" if estimate else NOTHING


def _incomplete(method: Method, place: Place, cells: Cells) -> str:
    group, column = place
    cell = cells.get((method.name, column.problem))
    if cell is None or not 0 < cell.attempts < cell.wanted:
        return ""
    where = " ".join(filter(None, (one_line(group.title), one_line(column.title))))
    return f"* {one_line(method.name)}, {where}: {cell.attempts}/{cell.wanted} runs"


def _published(
    row: str, places: Sequence[Place], measures: Sequence[str], sources: Sequence[Published]
) -> Iterator[tuple[str, ...]]:
    for number, published in enumerate(sources, 1):
        found = [published.of(row, column.problem) for _, column in places]
        if any(found):
            yield (_source_name(number, sources), *(_theirs(place, m) for place in found for m in measures))


def _theirs(place: Mapping[str, float], measure: str) -> str:
    if measure not in place:
        return NOTHING
    return figure(place[measure] / 100 if measure == "success" else place[measure], measure)


def _is_beside(published: Published, experiment: Experiment, places: Sequence[Place]) -> bool:
    return any(published.of(method.row, column.problem) for method in experiment.methods for _, column in places)


def _source_name(number: int, sources: Sequence[Published]) -> str:
    label = one_line(sources[number - 1].label)
    same = [source.label for source in sources].count(sources[number - 1].label) > 1
    return f"- {label} ({number})" if same else f"- {label}"
