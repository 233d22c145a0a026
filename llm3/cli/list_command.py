"""Show every plugin of every kind, where it comes from, and what failed to load."""

from __future__ import annotations

from argparse import ArgumentParser, Namespace

from llm3.cli.text import printable
from llm3.jsonio import dumps
from llm3.registry import HOOKS, Registration, Registry


def add_arguments(parser: ArgumentParser) -> None:
    """Add the command's arguments."""
    parser.add_argument("--json", action="store_true", help="print one JSON object")


def run(arguments: Namespace) -> int:
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
        print(dumps({**found, "broken": registry.broken}))
        return 0
    for kind in HOOKS:
        print(f"{kind}:")
        for r in registry.registrations(kind):
            print(printable(f"{r.name:<16}{r.plugin:<28}{_description(registry, r)}", keep_spaces=True, indent=2))
    if registry.broken:
        print("failed to load:")
        for broken in registry.broken:
            print(printable(f"{broken.plugin}: {broken.reason}", indent=2))
    return 0


def _description(registry: Registry, registration: Registration) -> str:
    """One line about a domain or a strategy; for the other kinds the name has to do."""
    try:
        if registration.kind == "domain":
            domain = registry.domain(registration.name)
            return f"{domain.description} Settings: {', '.join(domain.settings)}."
        if registration.kind == "strategy":
            return registry.strategy(registration.name).description
    except Exception as error:  # a broken plugin is what this list is there to show
        return f"cannot be made: {type(error).__name__}: {error}"
    return ""
