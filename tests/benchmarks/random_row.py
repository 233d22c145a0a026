"""The paper's random row (its Table II): uniform placements in the basket until a plan works. A table in Markdown.

    export OMP_NUM_THREADS=1 OPENBLAS_NUM_THREADS=1
    python tests/benchmarks/random_row.py [--attempts 50] [--setting medium-small]

An iteration is one proposal, drawn at random and tried action by action, with everything that belongs to it: the
prompt, the reply and its parsing, all motions, physics and the feedback. An attempt has a problem and a seed of its own
and ends when a proposal works, or after 2,000. Making the world of an attempt (two simulators, the robot's collision
shapes) is not part of an iteration; it is told beside it.
"""

from __future__ import annotations

import argparse
import sys
from dataclasses import dataclass
from time import perf_counter

import numpy as np

from llm3.assembly import RunConfig, assemble
from llm3.registry import Registry

PAPER = ("the paper", "109.6", "663.1", "", "")
MOST_ITERATIONS = 2000


@dataclass(frozen=True)
class Attempt:
    """One problem."""

    solved: bool
    iterations: int
    motion_calls: int
    reused: int
    seconds: float
    """Of all iterations."""
    start_up: float
    """Seconds to make the world."""


def attempt(registry: Registry, setting: str, seed: int) -> Attempt:
    """Propose at random until a plan works."""
    config = RunConfig(
        "boxpack", setting=setting, seed=seed, llm="random", max_llm_calls=MOST_ITERATIONS, timing="none"
    )
    began = perf_counter()
    with assemble(registry, config) as run:
        ready = perf_counter()
        result = run.solve()
        ended = perf_counter()
    stats = result.stats
    return Attempt(
        result.solved, stats.llm_calls, stats.motion_calls, stats.reused_actions, ended - ready, ready - began
    )


def main() -> None:
    """Run all attempts, and write the table to stdout."""
    parser = argparse.ArgumentParser(description=__doc__.partition("\n")[0])
    parser.add_argument("--attempts", type=int, default=50, help="how many (default: 50)")
    parser.add_argument("--setting", default="medium-small", help="the problem family (default: medium-small)")
    arguments = parser.parse_args()
    registry = Registry.discover()
    began = perf_counter()
    attempts = []
    for seed in range(arguments.attempts):
        attempts.append(attempt(registry, arguments.setting, seed))
        sys.stderr.write(f"\r{seed + 1} of {arguments.attempts}")
    whole = perf_counter() - began
    iterations = np.array([a.iterations for a in attempts])
    rows = [
        ("", "iterations", "#MP", "ms an iteration", "solved"),
        ("---",) * 5,
        (
            f"llm3, {arguments.setting}",
            f"{iterations.mean():.1f}",
            f"{np.mean([a.motion_calls for a in attempts]):.1f} "
            f"({np.mean([a.motion_calls + a.reused for a in attempts]):.1f} with reused ones)",
            f"{1000 * sum(a.seconds for a in attempts) / iterations.sum():.1f}",
            f"{sum(a.solved for a in attempts)}/{len(attempts)}",
        ),
        PAPER,
    ]
    text = "\n".join(f"| {' | '.join(row)} |" for row in rows)
    start_up = np.median([a.start_up for a in attempts])
    sys.stdout.write(f"{text}\n\nThe whole row: {whole:.0f} s; to make a world: {start_up:.2f} s in the median.\n")


if __name__ == "__main__":
    main()
