"""Make one tiny call to a model, and say in a line what was found, or what is wrong and what to set."""

from __future__ import annotations

from argparse import ArgumentParser, Namespace
from contextlib import closing
from typing import TextIO

from llm3.assembly import RunConfig
from llm3.cli.text import emit, printable
from llm3.errors import UsageError
from llm3.guarded import guarded
from llm3.interfaces import BackendSettings
from llm3.registry import Registry


def add_arguments(parser: ArgumentParser) -> None:
    """Add the command's arguments."""
    add = parser.add_argument
    add("--model", metavar="NAME", help="the language model, as for a run")
    add("--llm", metavar="NAME", help="the backend (default: http)")
    add("--temperature", type=float, metavar="T", help="sent to the model only if given")
    add("--max-reply-tokens", type=int, metavar="N", help="what the model may write (default: its own)")


def run(arguments: Namespace, out: TextIO) -> int:
    """Run the command."""
    if arguments.model is None and arguments.llm is None:
        raise UsageError("no model: give --model NAME. 'llm3 models' shows where models can be had.")
    config = RunConfig(
        domain="",
        llm=arguments.llm,
        model=arguments.model,
        temperature=arguments.temperature,
        max_reply_tokens=arguments.max_reply_tokens,
    )
    name, _, argument = config.backend.partition(":")
    settings = BackendSettings(
        argument=argument or None,
        model=config.model,
        temperature=config.temperature,
        max_reply_tokens=config.max_reply_tokens,
    )
    with closing(Registry.discover().backend(name, settings)) as backend:
        emit(printable(guarded(backend.examine, (str,))) + "\n", out)
    return 0
