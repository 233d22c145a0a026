"""Entry point: picks the command, and turns every ending into an exit code."""

from __future__ import annotations

import importlib
import signal
import sys
import threading
import traceback
from argparse import ArgumentParser, Namespace, RawDescriptionHelpFormatter
from collections.abc import Iterator, Sequence
from contextlib import contextmanager, redirect_stdout
from typing import TYPE_CHECKING, NoReturn

from llm3.cli.text import emit, open_streams, printable
from llm3.errors import LLM3Error, UnknownName, UsageError

if TYPE_CHECKING:
    from _typeshed import SupportsWrite

COMMANDS = {
    "run": "plan for one problem (the command that is meant when none is named)",
    "prompt": "print what a model would be sent first, without sending it",
    "experiment": "run many methods on many problems, as the tables of the paper do",
    "instance": "write a problem to a file, for --instance",
    "verify": "check a plan again, in a fresh world and without a model",
    "execute": "carry a plan out with motors, friction and gravity, and say what became of it",
    "export": "write the motions of a plan to a file for a robot",
    "report": "write what happened in a run, or came of an experiment, as a page to read",
    "render": "make a film or a picture of a plan, or of an attempt",
    "results": "print the tables of experiments, and draw their figures",
    "models": "show where models can be had, and which keys are set",
    "doctor": "make one tiny call to a model, and say what is wrong",
    "check": "look for faults in a plugin, and say what may be the cause",
    "new": "write a package to begin with: a plugin that works, with its tests",
    "list": "show every plugin, where it comes from, and what failed to load",
}
INTERRUPTED, TERMINATED = 130, 143


class _Terminated(KeyboardInterrupt):
    """Somebody asked the process to end, as a batch system does: as clean an ending as Ctrl-C."""


class CommandParser(ArgumentParser):
    """argparse whose errors are one line, like all others."""

    def error(self, message: str) -> NoReturn:
        """Turn a complaint of argparse into an error of ours."""
        raise UsageError(f"{message}. See '{self.prog} --help'.")

    def _print_message(self, message: str, file: SupportsWrite[str] | None = None) -> None:  # noqa: ARG002  # argparse's
        emit(message, sys.stdout)  # --help and --version

    def read(self, arguments: Sequence[str]) -> Namespace:
        """Parse, and say what comes close to what is not known."""
        options, unknown = self.parse_known_args(arguments)
        if not unknown:
            return options
        word = unknown[0].partition("=")[0]
        if word.startswith("-"):
            raise UnknownName("flag", word, self._option_string_actions)
        raise UsageError(f"unexpected argument {word!r}. A command stands first: {', '.join(COMMANDS)}.")


class _Formatter(RawDescriptionHelpFormatter):
    """Fixed width, so that the help reads the same everywhere and the docs can quote it."""

    def __init__(self, prog: str) -> None:
        super().__init__(prog, max_help_position=28, width=100)


def build_parser(command: str) -> CommandParser:
    """The argument parser of one command."""
    module = importlib.import_module(f"llm3.cli.{command}_command")
    epilog = None
    if command == "run":
        lines = "".join(f"  llm3 {name:<12}{text}\n" for name, text in COMMANDS.items())
        epilog = f"commands:\n{lines}\n'llm3 COMMAND --help' tells more of each."
    parser = CommandParser(
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
        0 solved or done, 1 not solved, 2 a usage error, 3 any other error, 130 after Ctrl-C, 143 after SIGTERM.
    """
    open_streams()
    arguments = list(sys.argv[1:] if argv is None else argv)
    debug = "--debug" in arguments  # an argument that cannot be parsed may be what is wrong
    try:
        with _ended_by_sigterm():
            return _run(arguments)
    except _Terminated:
        sys.stderr.write("llm3: terminated.\n")
        return TERMINATED
    except KeyboardInterrupt:
        sys.stderr.write("llm3: interrupted.\n")
        return INTERRUPTED
    except LLM3Error as error:
        return _report(str(error), error.exit_code, debug)
    except BaseException as error:  # the last line of defence, also against a plugin that calls sys.exit
        text = f"internal error: {type(error).__name__}: {error} (--debug shows the traceback)"
        return _report(text, LLM3Error.exit_code, debug)


@contextmanager
def _ended_by_sigterm() -> Iterator[None]:
    """Make SIGTERM end the block as Ctrl-C does; in any but the main thread, which alone gets signals, do nothing."""

    def end(_signal: int, _frame: object) -> NoReturn:
        raise _Terminated

    if threading.current_thread() is not threading.main_thread():
        yield
        return
    before = signal.signal(signal.SIGTERM, end)
    try:
        yield
    finally:
        signal.signal(signal.SIGTERM, before)


def _run(arguments: list[str]) -> int:
    first = arguments[0] if arguments else ""
    if first and not first.startswith("-") and first not in COMMANDS:
        raise UnknownName("command", first, COMMANDS)
    command, rest = (first, arguments[1:]) if first in COMMANDS else ("run", arguments)
    try:
        options = build_parser(command).read(rest)
    except SystemExit:  # --help and --version have said what there is to say
        return 0
    result = sys.stdout
    with redirect_stdout(sys.stderr):  # what a plugin prints is no result
        code: int = importlib.import_module(f"llm3.cli.{command}_command").run(options, result)
    return code


def _report(text: str, code: int, debug: bool) -> int:
    if debug:
        traceback.print_exc()
    sys.stderr.write(f"llm3: error: {printable(text)}\n")
    return code
