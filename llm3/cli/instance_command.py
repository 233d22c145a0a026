"""Write a problem to a file that --instance reads: edit it to make a problem of your own."""

from __future__ import annotations

from argparse import ArgumentParser, Namespace
from typing import Any, TextIO

from llm3.assembly import RunConfig, choose_instance, choose_timer, open_problem
from llm3.cli.output_file import check_free, write_file
from llm3.cli.problem_arguments import add_option_arguments, add_problem_arguments, chosen_domain, chosen_options, path
from llm3.cli.text import emit
from llm3.errors import UsageError
from llm3.interfaces import Domain, PlannerSettings
from llm3.jsonio import pretty
from llm3.registry import Registry
from llm3.witness import witness


def add_arguments(parser: ArgumentParser) -> None:
    """Add the command's arguments."""
    add_problem_arguments(parser)
    add_option_arguments(parser)
    parser.add_argument("--out", type=path, metavar="FILE", help="where to write it (default: to stdout)")
    parser.add_argument(
        "--witness",
        type=path,
        metavar="FILE",
        help="also write a plan that solves it, where the domain knows one: a proof, for 'llm3 verify'",
    )
    parser.add_argument("--force", action="store_true", help="overwrite these files")


def run(arguments: Namespace, out: TextIO) -> int:
    """Run the command."""
    registry = Registry.discover()
    domain = chosen_domain(registry, arguments)
    instance = choose_instance(domain, arguments.setting, arguments.seed)
    _check_files(arguments)
    if arguments.witness:
        write_file(arguments.witness, _witness(registry, domain, instance, arguments))
    if arguments.out:
        write_file(arguments.out, pretty(instance))
    else:
        emit(pretty(instance), out)
    return 0


def _check_files(arguments: Namespace) -> None:
    """See that both files can be written, before any work."""
    files = [file for file in (arguments.out, arguments.witness) if file]
    if len({file.resolve() for file in files}) < len(files):
        raise UsageError(f"--out and --witness are both '{arguments.out}': give two files.")
    for file in files:
        check_free(file, arguments.force)


def _witness(registry: Registry, domain: Domain, instance: Any, arguments: Namespace) -> str:
    """The plan that solves it, as its file holds it."""
    setting = arguments.setting or domain.default_setting
    defaults = RunConfig(domain.name)
    planner = registry.planner(defaults.planner, PlannerSettings(defaults.planner_iterations, defaults.planner_seconds))
    source = f"{domain.name}/{setting}, seed {arguments.seed}"
    with open_problem(domain, instance, chosen_options(arguments), source) as problem:
        found = witness(problem, setting, arguments.seed, planner, choose_timer(registry, None))
    return pretty(found)
