"""Write what happened in a run, or what came of an experiment, as one page that needs no network."""

from __future__ import annotations

import sys
from argparse import ArgumentParser, Namespace
from pathlib import Path
from typing import TextIO

from llm3.cli.output_file import check_free, write_file
from llm3.cli.problem_arguments import path
from llm3.cli.text import emit, printable
from llm3.errors import InputError
from llm3.experiments import EXPERIMENT_FILE, ExperimentRecord, read_experiment_folder
from llm3.registry import Registry


def add_arguments(parser: ArgumentParser) -> None:
    """Add the command's arguments."""
    add = parser.add_argument
    add("folder", type=path, metavar="DIR", help="the folder of a run, or of an experiment")
    add("--out", type=path, metavar="FILE", help="the page (default: report.html in DIR, which is overwritten)")
    add("--force", action="store_true", help="overwrite FILE")
    add(
        "--small",
        action="store_true",
        help="of a run: no pictures of the plan, no replay; of an experiment: no reports of its runs",
    )
    add("--quiet", action="store_true", help="no progress on stderr")


def run(arguments: Namespace, out: TextIO) -> int:
    """Run the command."""
    from llm3.report import PAGE, experiment_report, run_report

    folder: Path = arguments.folder.parent if arguments.folder.is_file() else arguments.folder
    file: Path = arguments.out or folder / PAGE
    check_free(file, arguments.force or not arguments.out)  # a report in its own place is written anew
    registry = Registry.discover()
    if (folder / EXPERIMENT_FILE).exists():
        record = read_experiment_folder(folder)
        if not arguments.small:
            _write_runs(registry, record, arguments.quiet)
        report = experiment_report(registry, record, file.parent)
    elif folder.exists() and not (folder / "run.json").exists():
        hint = f" 'llm3 render' draws '{arguments.folder}' by itself." if arguments.folder.is_file() else ""
        raise InputError(
            f"'{folder}' holds neither run.json nor {EXPERIMENT_FILE}: it is no folder of a run or an experiment.{hint}"
        )
    else:
        report = run_report(registry, folder, moving=not arguments.small)
    write_file(file, report.page)
    for note in report.notes if not arguments.quiet else ():
        sys.stderr.write(f"{printable(note)}\n")
    emit(f"{file}\n", out)
    return 0


def _write_runs(registry: Registry, record: ExperimentRecord, quiet: bool) -> None:
    """Write the reports of an experiment's runs, but for those that are newer than their records."""
    from llm3.cli.progress_view import ProgressView  # rich takes a while to import
    from llm3.report import PAGE, recorded_runs, run_report

    missing = [folder for folder in recorded_runs(record) if not _is_newer(folder / PAGE, folder / "run.json")]
    with ProgressView("report", len(missing), quiet) as view:
        for folder in missing:
            write_file(folder / PAGE, run_report(registry, folder, moving=False).page)
            view.advance()


def _is_newer(file: Path, other: Path) -> bool:
    return file.exists() and file.stat().st_mtime_ns >= other.stat().st_mtime_ns
