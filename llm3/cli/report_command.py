"""Write what happened in a run, or what came of an experiment, as one HTML page that needs no network."""

from __future__ import annotations

import sys
from argparse import ArgumentParser, Namespace
from pathlib import Path
from typing import TextIO

from llm3.cli.problem_arguments import path
from llm3.cli.text import emit, printable
from llm3.errors import LLM3Error, OutputExists
from llm3.records.whole_file import write_whole
from llm3.registry import Registry

PAGE = "report.html"


def add_arguments(parser: ArgumentParser) -> None:
    """Add the command's arguments."""
    add = parser.add_argument
    add("folder", type=path, metavar="DIR", help="the folder of a run")
    add("--out", type=path, metavar="FILE", help="the page (default: report.html in DIR)")
    add("--force", action="store_true", help="overwrite FILE")
    add("--small", action="store_true", help="without pictures of the plan and the replay in three dimensions")
    add("--quiet", action="store_true", help="no remarks on stderr")


def run(arguments: Namespace, out: TextIO) -> int:
    """Run the command."""
    from llm3.report import run_report

    file: Path = arguments.out or arguments.folder / PAGE
    if arguments.out and file.exists() and not arguments.force:
        raise OutputExists(f"'{file}' exists: give another --out, or --force.")
    report = run_report(Registry.discover(), arguments.folder, moving=not arguments.small)
    try:
        write_whole(file, report.page)
    except OSError as error:
        raise LLM3Error(f"'{file}' cannot be written: {error.strerror or error}.") from error
    for note in report.notes if not arguments.quiet else ():
        sys.stderr.write(f"{printable(note)}\n")
    emit(f"{file}\n", out)
    return 0
