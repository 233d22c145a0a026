"""Print the tables of experiments, with intervals and paired differences; draw the figures with --plot."""

from __future__ import annotations

import sys
from argparse import ArgumentParser, Namespace
from typing import TextIO

from llm3.cli.problem_arguments import path
from llm3.cli.text import emit, printable
from llm3.errors import UnknownName
from llm3.experiments import read_experiment_folder

FORMATS = ("text", "markdown", "csv")


def add_arguments(parser: ArgumentParser) -> None:
    """Add the command's arguments."""
    parser.add_argument("folders", type=path, nargs="+", metavar="DIR", help="the folder of an experiment")
    parser.add_argument("--format", metavar="NAME", default="text", help="text, markdown or csv (default: text)")
    parser.add_argument("--no-seconds", action="store_true", help="leave out what depends on the machine")
    parser.add_argument("--plot", type=path, metavar="FOLDER", help="draw the figures there, as PNG files")


def run(arguments: Namespace, out: TextIO) -> int:
    """Run the command."""
    if arguments.format not in FORMATS:
        raise UnknownName("format", arguments.format, FORMATS)
    from llm3.results import as_csv, as_markdown, as_text, report, summarize

    if arguments.plot:
        from llm3.results.figures import check_matplotlib

        check_matplotlib()
    records = [read_experiment_folder(folder) for folder in arguments.folders]
    seconds = not arguments.no_seconds
    summaries = summarize(records, seconds)
    if arguments.format == "csv":
        emit(as_csv(summaries, seconds), out)
    else:
        write = as_text if arguments.format == "text" else as_markdown
        emit(write(report(summaries, seconds)), out)
    if arguments.plot:
        from llm3.registry import Registry
        from llm3.results.figures import draw

        for line in draw(summaries, arguments.plot, Registry.discover(), seconds):
            sys.stderr.write(f"{printable(line)}\n")
    return 0
