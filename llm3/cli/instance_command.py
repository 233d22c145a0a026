"""Write a problem to a file that --instance reads: edit it to make a problem of your own."""

from __future__ import annotations

from argparse import ArgumentParser, Namespace
from typing import TextIO

from llm3.assembly import choose_instance
from llm3.cli.problem_arguments import add_problem_arguments, chosen_domain, path
from llm3.cli.text import emit
from llm3.errors import LLM3Error, OutputExists
from llm3.jsonio import pretty
from llm3.registry import Registry


def add_arguments(parser: ArgumentParser) -> None:
    """Add the command's arguments."""
    add_problem_arguments(parser)
    parser.add_argument("--out", type=path, metavar="FILE", help="where to write it (default: to stdout)")
    parser.add_argument("--force", action="store_true", help="overwrite FILE")


def run(arguments: Namespace, out: TextIO) -> int:
    """Run the command."""
    domain = chosen_domain(Registry.discover(), arguments)
    text = pretty(choose_instance(domain, arguments.setting, arguments.seed))
    if not arguments.out:
        emit(text, out)
        return 0
    try:
        with arguments.out.open("w" if arguments.force else "x", encoding="utf-8") as file:
            file.write(text)
    except FileExistsError:
        raise OutputExists(f"'{arguments.out}' exists: choose another file, or give --force.") from None
    except OSError as error:
        raise LLM3Error(f"'{arguments.out}' cannot be written: {error.strerror or error}.") from error
    return 0
