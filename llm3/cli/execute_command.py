"""Carry a plan out with motors, friction and gravity instead of teleporting, and say what became of it."""

from __future__ import annotations

from argparse import ArgumentParser, Namespace
from collections.abc import Iterator
from functools import partial
from math import degrees
from typing import TextIO

from llm3.cli.problem_arguments import LARGEST_SEED, number, path, seed, whole
from llm3.cli.text import emit, printable
from llm3.errors import UsageError
from llm3.execution import execute, open_executor
from llm3.jsonio import dumps
from llm3.records import PlanFile, open_plan, read_plan
from llm3.registry import Registry
from llm3.seeding import generator
from llm3.types import ExecutionReport, Noise

MOST_TIMES = 10_000


def add_arguments(parser: ArgumentParser) -> None:
    """Add the command's arguments."""
    add = parser.add_argument
    add("plan", type=path, metavar="PLAN", help="a plan.json, or the folder of a run")
    spread = partial(number, least=0.0, most=1.0)
    add(
        "--position-noise",
        type=spread,
        default=0.0,
        metavar="METRES",
        help="standard deviation of where each object starts, along x and y (default: 0)",
    )
    add(
        "--angle-noise",
        type=spread,
        default=0.0,
        metavar="RADIANS",
        help="standard deviation of how far each object is turned at the start (default: 0)",
    )
    add(
        "--joint-noise",
        type=spread,
        default=0.0,
        metavar="RADIANS",
        help="standard deviation of what each joint's encoder is off by; metres where a joint slides (default: 0)",
    )
    add("--seed", type=seed, default=0, help="of the noise (default: 0)")
    add(
        "--times",
        type=partial(whole, least=1, most=MOST_TIMES),
        default=1,
        metavar="N",
        help="carry it out N times, with the seed and those that follow it (default: 1)",
    )
    add("--json", action="store_true", help="print one JSON object")


def run(arguments: Namespace, out: TextIO) -> int:
    """Run the command: 0 if the goal is reached at the end, each time; else 1."""
    first, times = arguments.seed, arguments.times
    if first > LARGEST_SEED - times + 1:
        raise UsageError(f"--seed {first} leaves no room for {times} seeds: the largest is {LARGEST_SEED}.")
    plan = read_plan(arguments.plan)
    noise = Noise(arguments.position_noise, arguments.angle_noise, arguments.joint_noise)
    reports: dict[int, ExecutionReport] = {}
    with open_plan(Registry.discover(), plan) as problem, open_executor(problem, noise) as executor:
        for drawn in range(first, first + times):
            report = execute(problem, plan, executor, generator("execute", drawn))
            reports[drawn] = report
            if not arguments.json:
                lines = _lines(plan, report) if times == 1 else (f"seed {drawn}: {_ending(plan, report)}",)
                emit("".join(f"{printable(line)}\n" for line in lines), out)
    reached = sum(report.goal.achieved for report in reports.values())
    if arguments.json:
        emit(dumps(_summary(plan, noise, reports)) + "\n", out)
    elif times > 1:
        emit(f"goal reached in {reached} of {times}\n", out)
    return 0 if reached == times else 1


def _lines(plan: PlanFile, report: ExecutionReport) -> Iterator[str]:
    for place, done in enumerate(report.execution.actions, start=1):
        yield f"action {place} {done.action}, {done.seconds:.1f} s: {'; '.join(map(str, done.slips)) or 'as planned'}"
    yield _ending(plan, report)


def _ending(plan: PlanFile, report: ExecutionReport) -> str:
    """Whether the goal is reached, what is missing, and the largest errors."""
    actions, errors = report.execution.actions, report.pose_errors
    units = " or ".join(dict.fromkeys(joint.unit for joint in plan.joints))
    figures = [f"joints off by up to {max((a.joint_error for a in actions), default=0.0):.4f} {units}".rstrip()]
    tools = [action.tool_error for action in actions if action.tool_error is not None]
    if tools:
        figures.append(f"the tool by {max(tools) * 1000:.1f} mm")
    if errors:
        worst = max(errors, key=lambda name: errors[name].position)
        error = errors[worst]
        figures.append(f"in the end {worst} by {error.position * 1000:.1f} mm and {degrees(error.angle):.1f} degrees")
    goal = "goal reached" if report.goal.achieved else f"goal not reached: {'; '.join(report.goal.unmet)}"
    return f"{goal} ({', '.join(figures)})"


def _summary(plan: PlanFile, noise: Noise, reports: dict[int, ExecutionReport]) -> dict[str, object]:
    return {
        "domain": plan.domain,
        "noise": noise,
        "times": len(reports),
        "reached": sum(report.goal.achieved for report in reports.values()),
        "executions": [
            {
                "seed": drawn,
                "goal": report.goal,
                "start": report.execution.start,
                "state": report.execution.state,
                "actions": report.execution.actions,
                "pose_errors": report.pose_errors,
            }
            for drawn, report in reports.items()
        ],
    }
