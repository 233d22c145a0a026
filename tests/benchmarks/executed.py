"""How many verified plans end with the goal reached once they are carried out with motors, friction and gravity: a
table in Markdown, and what went wrong in the others.

    export OMP_NUM_THREADS=1 OPENBLAS_NUM_THREADS=1
    python tests/benchmarks/executed.py [--domain boxpack] [--seeds 15] [--robot panda] [--position-noise 0.002]
                                        [--angle-noise 0.01745]

The offline stand-in solves problems of every setting that is not made from solutions. Each plan that `llm3 verify`
finds sound is carried out as by `llm3 execute`, without noise and with it. Those of which the goal is missed are told
on stderr as they are found.
"""

from __future__ import annotations

import argparse
import re
import sys
from collections import Counter
from collections.abc import Iterator
from dataclasses import dataclass
from math import inf

from llm3.assembly import Problem, RunConfig, assemble
from llm3.execution import execute, open_executor
from llm3.jsonio import dumps, loads
from llm3.records import PlanFile
from llm3.records.plan import plan_file
from llm3.registry import Registry
from llm3.seeding import generator
from llm3.types import ExecutionReport, Noise
from llm3.verification import verify

BAD = 0.005
"""What is off by more than this, in metres, is no matter of accuracy."""
HEADER = "| setting | sound plans | goal reached without noise | goal reached with noise |\n|---|---|---|---|\n"


@dataclass(frozen=True)
class Pair:
    """A plan that was carried out without noise and with it."""

    calm: ExecutionReport
    noisy: ExecutionReport


def pairs(registry: Registry, setting: str, arguments: argparse.Namespace) -> Iterator[Pair]:
    """The plans of a setting that are sound, carried out."""
    noise = Noise(arguments.position_noise, arguments.angle_noise)
    for seed in range(arguments.seeds):
        config = RunConfig(arguments.domain, setting, seed, options={"robot": arguments.robot})
        with assemble(registry, config) as run:
            result = run.solve()
            plan = loads(dumps(plan_file(run.problem, result.start, result.plan)), PlanFile, "the plan")
            if not result.solved or not verify(run.problem, plan).sound:
                sys.stderr.write(f"{setting} {seed}: no sound plan\n")
                continue
            yield Pair(*(carried_out(run.problem, plan, setting, seed, each) for each in (Noise(), noise)))


def carried_out(problem: Problem, plan: PlanFile, setting: str, seed: int, noise: Noise) -> ExecutionReport:
    """A plan, executed once."""
    with open_executor(problem, noise) as executor:
        report = execute(problem, plan, executor, generator("execute", problem.domain.name, setting, seed))
    if not report.goal.achieved:
        told = [f"action {n}: {slip}" for n, a in enumerate(report.execution.actions, 1) for slip in a.slips]
        what = "; ".join((*report.goal.unmet, *told))
        sys.stderr.write(f"{setting} {seed}, {'with' if noise else 'without'} noise: {what}\n")
    return report


def causes(reports: list[ExecutionReport]) -> Counter[str]:
    """The first thing that went badly wrong in each of those that miss the goal, without names and figures."""
    found: Counter[str] = Counter()
    for report in reports:
        if not report.goal.achieved:
            slips = [slip for action in report.execution.actions for slip in action.slips]
            bad = [slip for slip in slips if slip.measures.get("position", inf) > BAD]
            names = "|".join(map(re.escape, report.execution.start.poses))
            sentence = next(map(str, bad or slips), "nothing that was noticed")
            found[re.sub(r"\d+\.\d+", "…", re.sub(names, "a box", sentence))] += 1
    return found


def row(name: str, seeds: int, found: list[Pair]) -> str:
    """A line of the table."""
    reached = (sum(r.goal.achieved for r in of) for of in ([p.calm for p in found], [p.noisy for p in found]))
    return f"| {name} | {len(found)} of {seeds} | {' | '.join(f'{n} of {len(found)}' for n in reached)} |\n"


def main() -> None:
    """Execute all plans, and write the table to stdout."""
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--domain", default="boxpack", help="whose plans (default: boxpack)")
    parser.add_argument("--seeds", type=int, default=15, help="of each setting, from 0 (default: 15)")
    parser.add_argument("--robot", default="panda", help="who carries them out (default: panda)")
    parser.add_argument("--position-noise", type=float, default=0.002, help="in metres (default: 0.002)")
    parser.add_argument("--angle-noise", type=float, default=0.01745, help="in radians (default: 0.01745, 1 degree)")
    arguments = parser.parse_args()
    registry = Registry.discover()
    everything: list[Pair] = []
    sys.stdout.write(HEADER)
    domain = registry.domain(arguments.domain)
    settings = [setting for setting in domain.settings if domain.witness(setting, 0) is None]
    for setting in settings:
        found = list(pairs(registry, setting, arguments))
        sys.stdout.write(row(setting, arguments.seeds, found))
        sys.stdout.flush()
        everything += found
    sys.stdout.write(row("all", arguments.seeds * len(settings), everything))
    for what, reports in (("without", [p.calm for p in everything]), ("with", [p.noisy for p in everything])):
        for cause, count in causes(reports).most_common():
            sys.stdout.write(f"\n{what} noise, {count}: {cause}")
    sys.stdout.write("\n")


if __name__ == "__main__":
    main()
