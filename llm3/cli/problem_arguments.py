"""The arguments that choose a problem, shared by several commands."""

from __future__ import annotations

from argparse import ArgumentParser, ArgumentTypeError, Namespace
from functools import partial
from math import nan
from pathlib import Path
from typing import Any

from llm3.assembly import RunConfig
from llm3.errors import UsageError
from llm3.interfaces import Domain
from llm3.jsonio import read_file
from llm3.registry import Registry

LARGEST_SEED = 2**63 - 1
"""What every reader of a record can hold as a whole number."""
_DEFAULT = RunConfig(domain="")


def add_problem_arguments(parser: ArgumentParser) -> None:
    """Add ``--domain``, ``--setting`` and ``--seed``."""
    parser.add_argument("--domain", metavar="NAME", help="the kind of problem, such as boxpack")
    parser.add_argument("--setting", metavar="NAME", help="a problem family (default: the domain's own)")
    parser.add_argument("--seed", type=seed, default=0, help="chooses the problem, and seeds the run (default: 0)")


def add_world_arguments(parser: ArgumentParser) -> None:
    """Add ``--instance`` and ``-D``."""
    parser.add_argument("--instance", type=path, metavar="FILE", help="load the problem from a JSON file instead")
    add_option_arguments(parser)


def add_option_arguments(parser: ArgumentParser) -> None:
    """Add ``-D``."""
    parser.add_argument(
        "-D",
        dest="options",
        metavar="KEY=VALUE",
        type=partial(pair, form="KEY=VALUE"),
        action="append",
        default=[],
        help="set an option of the domain; may be given several times",
    )


def add_prompt_arguments(parser: ArgumentParser) -> None:
    """Add ``--strategy``."""
    parser.add_argument(
        "--strategy",
        metavar="NAME",
        default=_DEFAULT.strategy,
        help=f"how the model is asked (default: {_DEFAULT.strategy})",
    )


def chosen_domain(registry: Registry, arguments: Namespace) -> Domain:
    """The domain that the user named.

    Raises:
        UsageError: None was named.
    """
    if not arguments.domain:
        raise UsageError(f"no domain: give --domain NAME. Known: {', '.join(registry.names('domain'))}.")
    return registry.domain(arguments.domain)


def loaded_instance(domain: Domain, arguments: Namespace) -> Any:
    """The instance of ``--instance``, or None.

    Raises:
        InputError: The file does not hold an instance of the domain.
    """
    if not arguments.instance:
        return None
    if arguments.setting is not None:
        raise UsageError("--setting and --instance both choose a problem: give one of them.")
    return read_file(arguments.instance, domain.instance_type)


def chosen_options(arguments: Namespace) -> dict[str, str]:
    """The domain's options that the user set.

    Raises:
        UsageError: One was set twice.
    """
    options: dict[str, str] = {}
    for key, value in arguments.options or ():
        if key in options:
            raise UsageError(f"-D {key} is given twice: {key}={options[key]} and {key}={value}.")
        options[key] = value
    return options


def path(text: str) -> Path:
    """A path that names something, for arguments."""
    if not text:
        raise ArgumentTypeError("expected a path, not an empty text")
    return Path(text)


def plan_name(plan: Path) -> str:
    """What a plan is called after: a run's folder, or the plan's file."""
    place = plan.resolve()
    if place.name == "plan.json":
        place = place.parent
    return place.stem if place.is_file() else place.name


def whole(text: str, least: int, most: int) -> int:
    """A whole number, for arguments."""
    if text.isascii() and text.isdigit() and len(text) <= len(str(most)) and least <= int(text) <= most:
        return int(text)
    raise ArgumentTypeError(f"expected a whole number from {least} to {most}, not {text!r}")


def number(text: str, least: float, most: float) -> float:
    """A number, for arguments."""
    try:
        value = float(text)
    except ValueError:
        value = nan
    if not least <= value <= most:
        raise ArgumentTypeError(f"expected a number from {least:g} to {most:g}, not {text!r}")
    return value


def seed(text: str) -> int:
    """A seed, for arguments."""
    return whole(text, 0, LARGEST_SEED)


def pair(text: str, form: str) -> tuple[str, str]:
    """What stands on both sides of the first ``=``, for arguments.

    Args:
        text: The argument.
        form: What it should look like, such as ``KEY=VALUE``.
    """
    key, equals, value = text.partition("=")
    if not key.strip() or not equals:
        raise ArgumentTypeError(f"expected {form}, not {text!r}")
    return key.strip(), value
