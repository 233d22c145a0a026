"""The report of an experiment: its tables and figures, and links to the reports of its runs."""

from __future__ import annotations

from base64 import b64encode
from collections.abc import Iterator
from dataclasses import dataclass
from os.path import relpath
from pathlib import Path
from tempfile import TemporaryDirectory

from llm3.errors import MissingDependency
from llm3.experiments import ExperimentRecord, record_folder
from llm3.registry import Registry
from llm3.report.page import render
from llm3.report.run_report import Report
from llm3.results import Summary, Table, report, summarize

PAGE = "report.html"
"""Of a run, in its folder; of an experiment, in its own."""


@dataclass(frozen=True)
class Plot:
    """A figure."""

    name: str
    image: str
    """As a data URI."""


@dataclass(frozen=True)
class Ended:
    """A run that ended."""

    method: str
    problem: str
    seed: int
    status: str
    calls: int
    motions: int
    seconds: float
    link: str
    """To its report; empty where there is none."""


def recorded_runs(record: ExperimentRecord) -> tuple[Path, ...]:
    """The folders of the runs that kept a record."""
    folders = (record.folder / record_folder(key) for key in record.runs)
    return tuple(folder for folder in folders if (folder / "run.json").exists())


def experiment_report(registry: Registry, record: ExperimentRecord, beside: Path) -> Report:
    """Tell an experiment, also one that goes on.

    Args:
        registry: Knows the domains, which draw the layouts.
        record: What is known of it.
        beside: The folder in which the page will stand, from which it links to the reports of runs.
    """
    (summary,) = summarize([record])
    plots, notes = _plots(registry, summary)
    sections = tuple(report([summary]))
    page = render(
        "experiment.html.jinja",
        record=record,
        sections=sections,
        is_table=lambda item: isinstance(item, Table),
        plots=plots,
        runs=tuple(_runs(record, beside)),
        notes=notes,
    )
    return Report(page, notes)


def _runs(record: ExperimentRecord, beside: Path) -> Iterator[Ended]:
    for key, line in record.runs.items():
        page = record.folder / record_folder(key) / PAGE
        link = Path(relpath(page, beside)).as_posix() if page.exists() else ""
        stats = line.stats
        yield Ended(
            key.method, key.problem, key.seed, line.status, stats.llm_calls, stats.motion_calls, line.seconds, link
        )


def _plots(registry: Registry, summary: Summary) -> tuple[tuple[Plot, ...], tuple[str, ...]]:
    """The figures, and why there are not more."""
    from llm3.results.figures import draw

    plots, notes = [], []
    with TemporaryDirectory() as folder:
        try:
            for line in draw([summary], Path(folder), registry):
                if (file := Path(line)).is_file():
                    image = b64encode(file.read_bytes()).decode()
                    plots.append(Plot(file.stem.replace("-", " ").replace("_", " "), f"data:image/png;base64,{image}"))
                else:
                    notes.append(line)
        except MissingDependency as error:
            notes.append(str(error))
    return tuple(plots), tuple(notes)
