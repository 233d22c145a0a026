"""Entry point: picks the command, and turns every ending into an exit code."""

from __future__ import annotations

import importlib
import os
import sys
import traceback
from argparse import ArgumentParser, RawDescriptionHelpFormatter
from collections.abc import Sequence
from typing import NoReturn

from llm3.cli.text import printable
from llm3.errors import LLM3Error

COMMANDS = {
    "run": "plan for one problem (the command that is meant when none is named)",
    "prompt": "print what a model would be sent first, without sending it",
    "instance": "write a problem to a file, for --instance",
    "list": "show every plugin, where it comes from, and what failed to load",
}
INTERRUPTED = 130


class _Parser(ArgumentParser):
    """argparse with errors in one line."""

    def error(self, message: str) -> NoReturn:
        sys.stderr.write(f"llm3: error: {printable(message)}. See '{self.prog} --help'.\n")
        sys.exit(2)


class _Formatter(RawDescriptionHelpFormatter):
    """Fixed width, so that the help reads the same everywhere and the docs can quote it."""

    def __init__(self, prog: str) -> None:
        super().__init__(prog, max_help_position=28, width=100)


def build_parser(command: str) -> ArgumentParser:
    """The argument parser of one command."""
    module = importlib.import_module(f"llm3.cli.{command}_command")
    epilog = None
    if command == "run":
        lines = "".join(f"  llm3 {name:<10}{text}\n" for name, text in COMMANDS.items())
        epilog = f"commands:\n{lines}\n'llm3 COMMAND --help' tells more of each."
    parser = _Parser(
        prog="llm3" if command == "run" else f"llm3 {command}",
        description=module.__doc__,
        epilog=epilog,
        allow_abbrev=False,
        formatter_class=_Formatter,
    )
    module.add_arguments(parser)
    parser.add_argument("--debug", action="store_true", help="show the traceback of an error")
    return parser


def main(argv: Sequence[str] | None = None) -> int:
    """Run one command.

    Returns:
        0 solved or done, 1 not solved, 2 a usage error, 3 any other error, 130 after Ctrl-C.
    """
    arguments = list(sys.argv[1:] if argv is None else argv)
    command = arguments.pop(0) if arguments and arguments[0] in COMMANDS else "run"
    try:
        options = build_parser(command).parse_args(arguments)
    except SystemExit as ending:  # argparse has said what there is to say
        return int(ending.code or 0)
    try:
        code: int = importlib.import_module(f"llm3.cli.{command}_command").run(options)
        sys.stdout.flush()
        return code
    except KeyboardInterrupt:
        sys.stderr.write("llm3: interrupted.\n")
        return INTERRUPTED
    except BrokenPipeError:  # the reader of stdout, such as `head`, has had enough
        os.dup2(os.open(os.devnull, os.O_WRONLY), sys.stdout.fileno())
        return 0
    except LLM3Error as error:
        return _report(str(error), error.exit_code, options.debug)
    except Exception as error:  # the last line of defence: one line instead of a traceback
        text = f"internal error: {type(error).__name__}: {error} (--debug shows the traceback)"
        return _report(text, LLM3Error.exit_code, options.debug)


def _report(text: str, code: int, debug: bool) -> int:
    if debug:
        traceback.print_exc()
    sys.stderr.write(f"llm3: error: {printable(text)}\n")
    return code
