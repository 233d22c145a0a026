"""Check a plan again, in a fresh world and without a model: one line for each defect."""

from __future__ import annotations

from argparse import ArgumentParser, Namespace
from collections.abc import Iterator
from typing import TextIO

from llm3.cli.problem_arguments import path
from llm3.cli.text import emit, printable
from llm3.export import plan_with, read_program
from llm3.jsonio import dumps
from llm3.records import PlanFile, open_plan, read_plan
from llm3.registry import Registry
from llm3.types import Verification
from llm3.verification import verify
from llm3.wording import counted


def add_arguments(parser: ArgumentParser) -> None:
    """Add the command's arguments."""
    parser.add_argument("plan", type=path, metavar="PLAN", help="a plan.json, or the folder of a run")
    parser.add_argument(
        "--trajectories",
        type=path,
        metavar="FILE",
        help="check these motions in place of the plan's: a .json, .csv or .npz of 'llm3 export'",
    )
    parser.add_argument("--json", action="store_true", help="print one JSON object")


def run(arguments: Namespace, out: TextIO) -> int:
    """Run the command: 0 sound, 1 not sound."""
    plan = read_plan(arguments.plan)
    if arguments.trajectories:
        plan = plan_with(plan, read_program(arguments.trajectories))
    with open_plan(Registry.discover(), plan) as problem:
        found = verify(problem, plan)
    if arguments.json:
        emit(dumps(_summary(plan, found)) + "\n", out)
    else:
        emit("".join(f"{printable(line)}\n" for line in _lines(plan, found)), out)
    return 0 if found.sound else 1


def _lines(plan: PlanFile, found: Verification) -> Iterator[str]:
    if not found.sound:
        yield from map(str, found.defects)
        return
    line = f"sound: {counted(len(plan.actions), 'action')}, {counted(found.configurations, 'configuration')} looked at"
    if found.configurations and found.deepest_contact is not None:
        line += f", deepest contact {found.deepest_contact * 1000:.2f} mm"
    yield line


def _summary(plan: PlanFile, found: Verification) -> dict[str, object]:
    return {
        "sound": found.sound,
        "domain": plan.domain,
        "actions": len(plan.actions),
        "configurations": found.configurations,
        "deepest_contact": found.deepest_contact,
        "clearances": found.clearances,
        "defects": found.defects,
    }
