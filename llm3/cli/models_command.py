"""Show where models can be had and which keys are set: what stands before the slash of --model NAME/MODEL."""

from __future__ import annotations

import os
from argparse import ArgumentParser, Namespace
from collections.abc import Iterator, Sequence
from typing import TextIO

from llm3.cli.text import emit, printable
from llm3.interfaces import ModelSource
from llm3.jsonio import dumps
from llm3.registry import Registry


def add_arguments(parser: ArgumentParser) -> None:
    """Add the command's arguments."""
    parser.add_argument("--json", action="store_true", help="print a JSON list")


def run(arguments: Namespace, out: TextIO) -> int:
    """Run the command."""
    sources = Registry.discover().model_sources(os.environ)
    emit(dumps(sources) + "\n" if arguments.json else "".join(f"{line}\n" for line in _table(sources)), out)
    return 0


def _table(sources: Sequence[ModelSource]) -> Iterator[str]:
    name = 2 + max((len(source.name) for source in sources), default=0)
    address = 2 + max((len(source.address) for source in sources), default=0)
    for source in sources:
        line = f"{source.name:<{name}}{source.address:<{address}}key {_key(source)}"
        yield printable(line, keep_spaces=True)


def _key(source: ModelSource) -> str:
    return source.key if source.key == "not needed" else f"{source.key}: {' or '.join(source.key_variables)}"
