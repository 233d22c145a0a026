"""Write a package to begin with: a plugin that works, with tests that pass, to be changed into your own."""

from __future__ import annotations

import importlib.util
import shlex
from argparse import ArgumentParser, Namespace
from pathlib import Path
from typing import TextIO

from llm3.cli.problem_arguments import path
from llm3.cli.text import emit
from llm3.errors import UnknownName, UsageError
from llm3.registry import Registry
from llm3.scaffold import BULLET_DOMAIN, KINDS, Kind, Name, render, write


def add_arguments(parser: ArgumentParser) -> None:
    """Add the command's arguments."""
    parser.add_argument("kind", metavar="KIND", help=f"what it is to be: {', '.join(KINDS)}")
    parser.add_argument("name", metavar="NAME", help="what the plugin is to be called, such as my-rooms")
    parser.add_argument("--bullet", action="store_true", help="a domain with a robot arm in PyBullet")
    parser.add_argument("--out", type=path, metavar="DIR", help="where the package goes (default: a new folder NAME)")


def run(arguments: Namespace, out: TextIO) -> int:
    """Run the command."""
    kind, name = _kind(arguments.kind, arguments.bullet), Name(arguments.name)
    _check_free(kind, name, Registry.discover())
    folder = arguments.out or Path(name.plugin)
    files = render(kind, name)
    write(files, folder)
    place = shlex.quote(str(folder))
    lines = (
        f"{place} holds {kind.what} that works, in {len(files)} files. Next:",
        f"  pip install -e {place}",
        f"  llm3 {kind.trial.replace('NAME', name.plugin)}",
        f"  llm3 check {kind.checked.replace('NAME', name.plugin)}",
        f"  pytest {place}",
    )
    emit("".join(f"{line}\n" for line in lines), out)
    return 0


def _kind(name: str, bullet: bool) -> Kind:
    if name not in KINDS:
        raise UnknownName("kind of plugin", name, KINDS)
    if bullet and name != "domain":
        raise UsageError(f"--bullet is for a domain: leave it out for a {name}.")
    return BULLET_DOMAIN if bullet else KINDS[name]


def _check_free(kind: Kind, name: Name, registry: Registry) -> None:
    """Refuse a name that would clash with something that is installed.

    Raises:
        UsageError: It would.
    """
    for registration in registry.registrations(kind.registered):
        if registration.name == name.plugin:
            raise UsageError(
                f"{kind.registered} {name.plugin!r} is registered by {registration.plugin}: choose another name."
            )
    found = importlib.util.find_spec(name.module)
    if found is not None:
        where = found.origin or ", ".join(found.submodule_search_locations or ())
        raise UsageError(f"a package {name.module!r} is installed, at {where}: choose another name.")
