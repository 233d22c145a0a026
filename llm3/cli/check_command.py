"""Look for faults in a plugin: try all that its kind promises, and say what is wrong and what may be the cause."""

from __future__ import annotations

from argparse import ArgumentParser, Namespace
from dataclasses import asdict
from typing import TextIO

from llm3.cli.problem_arguments import loaded_instance, path
from llm3.cli.text import emit, printable
from llm3.errors import UsageError
from llm3.interfaces import BackendSettings, PlannerSettings
from llm3.jsonio import dumps
from llm3.registry import Registry
from llm3.testing.conformance.attempts import SKELETON
from llm3.testing.conformance.backend import examine_backend
from llm3.testing.conformance.complaint import Report
from llm3.testing.conformance.domain import Given, examine_domain
from llm3.testing.conformance.feedback import examine_feedback
from llm3.testing.conformance.planner import examine_planner
from llm3.testing.conformance.strategy import examine_strategy
from llm3.testing.conformance.timer import examine_timer

KINDS = ("domain", "planner", "feedback", "backend", "strategy", "timer")
ITERATIONS = 500
"""What a planner may spend on one query of the kit."""


def add_arguments(parser: ArgumentParser) -> None:
    """Add the command's arguments."""
    add = parser.add_argument
    add("name", metavar="NAME", help="the plugin's name; of a backend also NAME:ARGUMENT, as for --llm")
    add("--kind", choices=KINDS, help="what it is, where things of several kinds have that name")
    add("--setting", metavar="NAME", help="look at one setting of a domain only (default: all)")
    add("--instance", type=path, metavar="FILE", help="look at one problem of a domain, from a JSON file")
    add("--model", metavar="NAME", help="the model of a backend, which is asked two tiny questions")
    add("--json", action="store_true", help="print one JSON object")


def run(arguments: Namespace, out: TextIO) -> int:
    """Run the command."""
    registry = Registry.discover()
    kind = arguments.kind or _kind(registry, arguments.name)
    for flag, of in (("setting", "domain"), ("instance", "domain"), ("model", "backend")):
        if getattr(arguments, flag) is not None and kind != of:
            raise UsageError(f"--{flag} is for a {of}, and {arguments.name!r} is a {kind}.")
    report = _examined(registry, kind, arguments)
    if arguments.json:
        emit(dumps({"kind": kind, "name": arguments.name, **asdict(report)}) + "\n", out)
    else:
        lines = [*map(str, report.complaints), *(f"remark: {remark}" for remark in report.remarks)]
        emit("".join(f"{printable(line)}\n" for line in [*lines, _summary(kind, arguments.name, report)]), out)
    return 1 if report.complaints else 0


def _kind(registry: Registry, name: str) -> str:
    """What has this name.

    Raises:
        UnknownName: Nothing has.
        UsageError: Things of several kinds have.
    """
    plain = name.partition(":")[0]
    kinds = [kind for kind in KINDS if (plain if kind == "backend" else name) in registry.names(kind)]
    if not kinds:
        raise registry.unknown("plugin", name, {known for kind in KINDS for known in registry.names(kind)})
    if len(kinds) > 1:
        raise UsageError(
            f"{name!r} is the name of a {' and of a '.join(kinds)}: give --kind {' or --kind '.join(kinds)}."
        )
    return kinds[0]


def _examined(registry: Registry, kind: str, arguments: Namespace) -> Report:
    name: str = arguments.name
    match kind:
        case "domain":
            domain = registry.domain(name)
            instance = loaded_instance(domain, arguments)
            given = Given(str(arguments.instance), instance) if arguments.instance else None
            return examine_domain(domain, registry, setting=arguments.setting, given=given)
        case "planner":
            planner = registry.planner(name, PlannerSettings(max_iterations=ITERATIONS))
            return examine_planner(planner, max_iterations=ITERATIONS)
        case "feedback":
            return examine_feedback(registry.feedback(name))
        case "strategy":
            return examine_strategy(registry.strategy(name))
        case "timer":
            return examine_timer(registry.timer(name))
        case _:
            plain, _, argument = name.partition(":")
            settings = BackendSettings(
                domain="of the check", argument=argument or None, model=arguments.model, skeleton=SKELETON
            )
            return examine_backend(registry.backend(plain, settings))


def _summary(kind: str, name: str, report: Report) -> str:
    faults = len(report.complaints)
    found = "no fault" if not faults else "1 fault" if faults == 1 else f"{faults} faults"
    looked = f"{report.rules} rules"
    if report.worlds:
        looked += f", {report.worlds} worlds"
    if report.actions:
        looked += f", {report.actions} actions of which {report.applied} were carried out"
    return f"{kind} {name!r}: {found} ({looked})."
