"""Solves problems with the offline stand-in and looks at every plan a second time: a table in Markdown.

    OMP_NUM_THREADS=1 OPENBLAS_NUM_THREADS=1 python tests/benchmarks/verify_plans.py [--seeds 50] [--robot panda]

The second look is that of `llm3 verify`, in a world made anew for each plan, from the JSON that the plan would be on
disk. Defects go to stderr as they are found, and end the script with exit code 1. Times are those of this machine.
"""

from __future__ import annotations

import argparse
import sys
from collections.abc import Iterator
from dataclasses import dataclass
from time import perf_counter

import numpy as np

from llm3.assembly import RunConfig, assemble
from llm3.jsonio import dumps, loads
from llm3.records import PlanFile, open_plan
from llm3.records.plan import plan_file
from llm3.registry import Registry
from llm3.types import Verification
from llm3.verification import verify
from llm3_boxpack.paper_settings import SETTINGS

HEADER = (
    "| setting | solved | sound | with times | seconds, median | seconds, max | configurations, median "
    "| deepest contact, mm | clearance of transits, mm |\n|---|---|---|---|---|---|---|---|---|"
)


@dataclass(frozen=True)
class Look:
    """A second look at the plan of one seed."""

    plan: PlanFile
    found: Verification
    seconds: float

    @property
    def timed(self) -> bool:
        """Whether all of its segments have a trajectory."""
        return all(s.trajectory for step in self.plan.actions for s in step.motion.segments)


def solved(registry: Registry, setting: str, seed: int, robot: str) -> PlanFile | None:
    """The plan of the stand-in, if it finds one."""
    with assemble(registry, RunConfig("boxpack", setting, seed, options={"robot": robot})) as run:
        result = run.solve()
        return (
            loads(dumps(plan_file(run.problem, result.start, result.plan)), PlanFile, "the plan")
            if result.solved
            else None
        )


def looks(registry: Registry, setting: str, seeds: int, robot: str) -> Iterator[Look]:
    """A second look at each plan of a setting."""
    for seed in range(seeds):
        plan = solved(registry, setting, seed, robot)
        if plan is None:
            sys.stderr.write(f"{setting} {seed}: not solved\n")
            continue
        with open_plan(registry, plan) as problem:
            began = perf_counter()
            found = verify(problem, plan)
            seconds = perf_counter() - began
        for defect in found.defects:
            sys.stderr.write(f"{setting} {seed}: {defect}\n")
        yield Look(plan, found, seconds)


def row(name: str, seeds: int, all_looks: list[Look]) -> str:
    """A line of the table."""
    sound = sum(look.found.sound for look in all_looks)
    if not all_looks:
        return f"| {name} | 0 of {seeds} |" + " |" * 7
    seconds = [look.seconds for look in all_looks]
    configurations = np.median([look.found.configurations for look in all_looks])
    deepest = max(look.found.deepest_contact for look in all_looks)
    clearances = [look.found.clearances.get("transit") for look in all_looks]
    nearest = min((clearance for clearance in clearances if clearance is not None), default=np.nan)
    return (
        f"| {name} | {len(all_looks)} of {seeds} | {sound} | {sum(look.timed for look in all_looks)} "
        f"| {np.median(seconds):.2f} | {max(seconds):.2f} | {configurations:.0f} | {1000 * deepest:.2f} "
        f"| {1000 * nearest:.1f} |"
    )


def main() -> int:
    """Look at all plans; 0 if every one is sound."""
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--seeds", type=int, default=50, help="of each setting, from 0 (default: 50)")
    parser.add_argument("--robot", default="panda", help="who packs (default: panda)")
    arguments = parser.parse_args()
    registry = Registry.discover()
    everything: list[Look] = []
    sys.stdout.write(f"{HEADER}\n")
    for setting in SETTINGS:
        found = list(looks(registry, setting, arguments.seeds, arguments.robot))
        sys.stdout.write(f"{row(setting, arguments.seeds, found)}\n")
        sys.stdout.flush()
        everything += found
    sys.stdout.write(f"{row('all', arguments.seeds * len(SETTINGS), everything)}\n")
    return 0 if all(look.found.sound for look in everything) else 1


if __name__ == "__main__":
    sys.exit(main())
