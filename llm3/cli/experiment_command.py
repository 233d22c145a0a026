"""Run an experiment: every method on the same problems with the same seeds. What was done before is not done again."""

from __future__ import annotations

from argparse import ArgumentParser, Namespace
from collections.abc import Iterable, Iterator, Mapping
from concurrent.futures import Executor
from contextlib import contextmanager
from pathlib import Path
from typing import TYPE_CHECKING, TextIO

from llm3.cli.experiment_choice import (
    add_choice_arguments,
    chosen_experiment,
    chosen_limits,
    chosen_part,
)
from llm3.cli.experiment_preview import preview
from llm3.cli.problem_arguments import pair, path, whole
from llm3.cli.text import emit, printable
from llm3.errors import UsageError
from llm3.experiments import (
    Experiment,
    ExperimentWriter,
    MethodOutlook,
    RunLine,
    look_ahead,
    missing_jobs,
    read_experiment_folder,
    run_experiment,
    settled,
    shares,
    versions_of,
)
from llm3.experiments.continuation import continued
from llm3.registry import Registry

if TYPE_CHECKING:
    from llm3.cli.experiment_view import ExperimentView

FOLDER = Path("experiments")
"""Where experiments go that are given no folder."""
MOST_WORKERS = 1000


def add_arguments(parser: ArgumentParser) -> None:
    """Add the command's arguments."""
    add_choice_arguments(parser)
    add = parser.add_argument
    add("--out", type=path, metavar="DIR", help="where it goes (default: experiments/ and its name)")
    add("--dry-run", action="store_true", help="tell how many runs and model calls it would be, and do nothing")
    add("--workers", type=_count, metavar="N", default=1, help="processes that do the runs (default: 1)")
    add("--dask", metavar="ADDRESS", help="do the runs on the Dask cluster with this scheduler instead")
    add(
        "--at-once",
        dest="limits",
        metavar="PROVIDER=N",
        type=_limit,
        action="append",
        default=[],
        help="at most so many model calls at once to a provider, such as openai=4",
    )
    add("--no-records", dest="records", action="store_false", help="keep of each run only what came of it")
    add("--retry", action="store_true", help="do those runs again that ended with an error or a crash")
    add("--mix-versions", action="store_true", help="go on in DIR though other versions began there")
    add("--quiet", action="store_true", help="no progress on stderr")


def run(arguments: Namespace, out: TextIO) -> int:
    """Run the command: 0 all runs have ended, 1 some of them with an error or a crash."""
    registry = Registry.discover()
    whole = settled(registry, chosen_experiment(registry, arguments))
    experiment = chosen_part(whole, arguments)
    limits = chosen_limits(experiment, arguments.limits)
    if arguments.dask is not None and arguments.workers != 1:
        raise UsageError("--workers and --dask both say where runs are done: give one of them.")
    outlooks = look_ahead(registry, experiment)
    folder: Path = arguments.out or FOLDER / whole.name
    versions = versions_of(experiment, outlooks.values())
    if arguments.dry_run:
        _, done = continued(folder, whole, versions, arguments.mix_versions)
        jobs = missing_jobs(experiment, done, arguments.retry)
        lines = preview(experiment, shares(experiment, jobs, outlooks), folder)
        emit("".join(f"{printable(line, keep_spaces=True)}\n" for line in lines), out)
        return 0
    with (
        _executor(arguments) as (executor, slots),
        ExperimentWriter(folder, whole, versions, arguments.mix_versions) as writer,
    ):
        _run(experiment, writer, executor, slots, limits, outlooks, arguments)
        failed = any(writer.ended[job.key].failed for job in experiment.jobs())
    emit(_results(folder), out)
    return 1 if failed else 0


def _run(
    experiment: Experiment,
    writer: ExperimentWriter,
    executor: Executor,
    slots: int,
    limits: Mapping[str, int],
    outlooks: Mapping[str, MethodOutlook],
    arguments: Namespace,
) -> None:
    from llm3.cli.experiment_view import ExperimentView  # rich takes a while to import

    jobs = missing_jobs(experiment, writer.ended, arguments.retry)
    view = ExperimentView(len(experiment), len(experiment) - len(jobs), arguments.quiet)
    for notice in dict.fromkeys(notice for outlook in outlooks.values() for notice in outlook.notices):
        view.note(notice)
    if len(jobs) < len(experiment):
        view.note(f"{len(experiment) - len(jobs)} of {len(experiment)} runs ended before in {writer.folder}")
    if not jobs:
        _tell_of_failures(view, writer.ended.values())
        return
    try:
        with view:
            run_experiment(
                jobs,
                writer,
                executor,
                slots,
                limits=limits,
                records=arguments.records,
                watcher=view,
            )
    finally:
        ended = [writer.ended[job.key] for job in experiment.jobs() if job.key in writer.ended]
        if len(ended) < len(experiment):
            view.note(f"{len(ended)} of {len(experiment)} runs have ended; the same command goes on with the rest")
        _tell_of_failures(view, ended)


def _tell_of_failures(view: ExperimentView, ended: Iterable[RunLine]) -> None:
    failed = sum(line.failed for line in ended)
    if failed:
        view.note(f"{failed} of them ended with an error or a crash; with --retry they are done again")


@contextmanager
def _executor(arguments: Namespace) -> Iterator[tuple[Executor, int]]:
    """Where runs are done, and how many at once."""
    if arguments.dask is None:
        from llm3.experiments.workers import SpawnedWorkers

        with SpawnedWorkers(arguments.workers) as workers:
            yield workers, arguments.workers
        return
    from llm3.experiments.cluster import connect

    with connect(arguments.dask) as (executor, slots):
        yield executor, slots


def _results(folder: Path) -> str:
    from llm3.results import as_text, report, summarize  # scipy takes a while to import

    return as_text(report(summarize([read_experiment_folder(folder)])))


def _count(text: str) -> int:
    return whole(text, 1, MOST_WORKERS)


def _limit(text: str) -> tuple[str, int]:
    provider, number = pair(text, "PROVIDER=N")
    return provider, _count(number)
