"""Write the motions of a plan to a file for a robot: trajectories, and what the gripper does between them."""

from __future__ import annotations

from argparse import ArgumentParser, Namespace
from functools import partial
from pathlib import Path
from typing import TextIO

from llm3.cli.output_file import check_free, write_file
from llm3.cli.problem_arguments import number, path, plan_name
from llm3.cli.text import emit
from llm3.errors import UsageError
from llm3.export import FORMATS, check_program, program_of, resampled, write_program
from llm3.export.formats import format_of
from llm3.records import open_plan, read_plan
from llm3.registry import Registry

SLOWEST, FASTEST = 1.0, 1000.0
"""Points a second."""


def add_arguments(parser: ArgumentParser) -> None:
    """Add the command's arguments."""
    add, rate = parser.add_argument, partial(number, least=SLOWEST, most=FASTEST)
    add("plan", type=path, metavar="PLAN", help="a plan.json, or the folder of a run")
    add("--format", choices=FORMATS, help="of the file (default: by the ending of --out, or ros2-json)")
    add("--out", type=path, metavar="FILE", help="a .json, .csv or .npz (default: one here, with the folder's name)")
    add(
        "--rate",
        type=rate,
        metavar="HZ",
        help="evenly spaced points, as many a second (default: those of the plan)",
    )
    add("--force", action="store_true", help="overwrite FILE")


def run(arguments: Namespace, out: TextIO) -> int:
    """Run the command."""
    name, file = _chosen(arguments)
    if file.exists() and arguments.plan.exists() and file.samefile(arguments.plan):
        raise UsageError(f"'{file}' is the plan itself: choose another file with --out.")
    check_free(file, arguments.force)
    plan = read_plan(arguments.plan)
    program = program_of(plan)
    with open_plan(Registry.discover(), plan) as problem:
        joints = problem.env.joints  # the limits are the robot's, whatever the plan says of them
    check_program(program, joints, plan.start.configuration)
    if arguments.rate:
        program = resampled(program, arguments.rate, joints)
        check_program(program, joints, plan.start.configuration, quintic=True)
    write_file(file, write_program(program, name, with_accelerations=bool(arguments.rate)))
    emit(f"{file}\n", out)
    return 0


def _chosen(arguments: Namespace) -> tuple[str, Path]:
    """The format and the file."""
    if not arguments.out:
        name = arguments.format or "ros2-json"
        return name, Path(plan_name(arguments.plan) + FORMATS[name].ending)
    name = format_of(arguments.out)
    if arguments.format not in (None, name):
        ending = FORMATS[arguments.format].ending
        raise UsageError(f"--format {arguments.format} makes a {ending}, and --out is '{arguments.out}'.")
    return name, arguments.out
