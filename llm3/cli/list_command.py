"""Show every plugin of every kind, where it comes from, and what failed to load."""

from __future__ import annotations

import inspect
from argparse import ArgumentParser, Namespace
from collections.abc import Iterator
from typing import TextIO

from llm3.cli.text import emit, printable
from llm3.errors import LLM3Error
from llm3.experiments import experiment_of, parse_toml
from llm3.jsonio import dumps
from llm3.registry import HOOKS, Registration, Registry


def add_arguments(parser: ArgumentParser) -> None:
    """Add the command's arguments."""
    parser.add_argument("--json", action="store_true", help="print one JSON object")


def run(arguments: Namespace, out: TextIO) -> int:
    """Run the command."""
    registry = Registry.discover()
    if arguments.json:
        found = {
            kind: [
                {"name": r.name, "plugin": r.plugin, "description": _description(registry, r)}
                for r in registry.registrations(kind)
            ]
            for kind in HOOKS
        }
        emit(dumps({**found, "broken": registry.broken}) + "\n", out)
    else:
        emit("".join(f"{line}\n" for line in _table(registry)), out)
    return 0


def _table(registry: Registry) -> Iterator[str]:
    rows = [r for kind in HOOKS for r in registry.registrations(kind)]
    name = 2 + max((len(r.name) for r in rows), default=0)
    plugin = 2 + max((len(r.plugin) for r in rows), default=0)
    for kind in HOOKS:
        yield f"{kind}:"
        for r in registry.registrations(kind):
            line = f"{r.name:<{name}}{r.plugin:<{plugin}}{_description(registry, r)}"
            yield printable(line, keep_spaces=True, indent=2)
    if registry.broken:
        yield "failed to load:"
        for broken in registry.broken:
            yield printable(f"{broken.plugin}: {broken.reason}", indent=2)


def _description(registry: Registry, registration: Registration) -> str:
    """One line: what a domain or a strategy says of itself, or the first line of a factory's docstring."""
    try:
        if registration.kind == "domain":
            domain = registry.domain(registration.name)
            return f"{domain.description} Settings: {', '.join(domain.settings)}."
        if registration.kind == "strategy":
            return registry.strategy(registration.name).description
        if registration.kind == "experiment":
            text = registry.experiment(registration.name)
            return experiment_of(parse_toml(text, registration.name), registration.name).title
    except LLM3Error as error:  # a broken plugin is what this list is there to show
        return str(error)
    except Exception as error:
        return f"cannot be made: {type(error).__name__}: {error}"
    documented = inspect.isroutine(registration.factory) or inspect.isclass(registration.factory)
    return (inspect.getdoc(registration.factory) or "").partition("\n")[0] if documented else ""
