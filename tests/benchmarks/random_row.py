"""Why our random row is not the one of the paper's Table II: what a box may reach over the basket's edge, and where its
centre is drawn. A table in Markdown.

    export OMP_NUM_THREADS=1 OPENBLAS_NUM_THREADS=1
    python tests/benchmarks/random_row.py [--attempts 50]

The published code lets a box reach 15 mm over the edge and draws its centre from the basket's whole rectangle; llm3
allows 1 mm and draws from where a box can lie at all. Here the random row is run as llm3 has it, with the first
difference undone, and with both, on the same instances. As an experiment, with all that belongs to one, the first of
them is `llm3 experiment table2 --method "Random Samples"`.
"""

from __future__ import annotations

import argparse
import sys
from dataclasses import dataclass
from typing import Any

import numpy as np

from llm3 import hookimpl
from llm3.assembly import RunConfig, prepare
from llm3.interfaces import Regions
from llm3.registry import Registry
from llm3.types import Stats
from llm3_boxpack import goal
from llm3_boxpack.actions import PLACE
from llm3_boxpack.domain import BoxPack

SETTING = "medium-small"
MOST_ITERATIONS = 2000
PUBLISHED = 0.015
"""What a box may reach over the edge in the published code, in metres."""
PAPER = ("the paper", "", "", "109.6", "663.1", "", "")


class WholeBasket(BoxPack):
    """Box packing in which centres are drawn from the whole basket."""

    name = "whole-basket"

    def regions(self, instance: Any) -> Regions:
        """The basket's rectangle for every box."""
        return {
            (PLACE.name, (box.name,), axis): (center - side / 2, center + side / 2)
            for box in instance.boxes
            for axis, center, side in zip("xy", instance.basket.center, instance.basket.size, strict=True)
        }


COMBINATIONS = ((BoxPack.name, goal.TOLERANCE), (BoxPack.name, PUBLISHED), (WholeBasket.name, PUBLISHED))


class Plugin:
    """Brings the domain."""

    @hookimpl
    def llm3_domains(self) -> dict[str, Any]:
        """The one above."""
        return {WholeBasket.name: WholeBasket}


@dataclass(frozen=True)
class Row:
    """What a combination came to."""

    solved: int
    stats: tuple[Stats, ...]

    def mean(self, *names: str) -> float:
        """The mean of a sum of counts."""
        return float(np.mean([sum(getattr(stats, name) for name in names) for stats in self.stats]))


def row(registry: Registry, domain: str, overhang: float, attempts: int) -> Row:
    """Run all attempts with one combination."""
    results = []
    env = None
    before, goal.TOLERANCE = goal.TOLERANCE, overhang
    try:
        for seed in range(attempts):
            config = RunConfig(
                domain, setting=SETTING, seed=seed, llm="random", max_llm_calls=MOST_ITERATIONS, timing="none"
            )
            with prepare(registry, config).open(spare=env) as run:
                results.append(run.solve())
                env = run.release()
            sys.stderr.write(f"\r{domain}, {overhang:g} m: {seed + 1} of {attempts} ")
    finally:
        goal.TOLERANCE = before
        if env:
            env.close()
    return Row(sum(result.solved for result in results), tuple(result.stats for result in results))


def main() -> None:
    """Run all combinations, and write the table to stdout."""
    parser = argparse.ArgumentParser(description=__doc__.partition(":")[0])
    parser.add_argument("--attempts", type=int, default=50, help="how many instances (default: 50)")
    arguments = parser.parse_args()
    registry = Registry.discover()
    registry.register(Plugin(), "this benchmark")
    lines = [
        ("", "over the edge", "centres from", "iterations", "#MP", "#MP with reused", "solved"),
        ("---",) * 7,
    ]
    for domain, overhang in COMBINATIONS:
        found = row(registry, domain, overhang, arguments.attempts)
        lines.append(
            (
                "llm3",
                f"{1000 * overhang:.0f} mm",
                "where a box can lie" if domain == BoxPack.name else "the whole basket",
                f"{found.mean('llm_calls'):.1f}",
                f"{found.mean('motion_calls'):.1f}",
                f"{found.mean('motion_calls', 'reused_actions'):.1f}",
                f"{found.solved}/{arguments.attempts}",
            )
        )
    sys.stdout.write("".join(f"| {' | '.join(line)} |\n" for line in (*lines, PAPER)))


if __name__ == "__main__":
    main()
