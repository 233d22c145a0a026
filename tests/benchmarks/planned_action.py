"""How long a planned action takes, and how often the offline stand-in packs the basket: two tables in Markdown.

    OMP_NUM_THREADS=1 OPENBLAS_NUM_THREADS=1 python tests/benchmarks/planned_action.py [--seeds 10] [--timed 5]

A planned action is everything between a proposed action and its outcome: inverse kinematics, collision checks, the
planner's query, and settling. Actions whose outcome was known already, and those that fail before any motion is
evaluated, are left out. The first run of a process is not timed, but every run has a world of its own, whose caches
fill at its first action: see the 90th percentile. The two variables keep numpy to one core. Nothing here is asserted:
times belong to a machine, and to how busy it is.
"""

from __future__ import annotations

import argparse
import sys
from collections.abc import Iterator, Mapping, Sequence
from time import perf_counter

import numpy as np

from llm3.assembly import RunConfig, assemble
from llm3.registry import Registry
from llm3.types import ActionTried, ReplyRead, Result, RunEvent
from llm3_boxpack.env import BoxpackEnv
from llm3_boxpack.paper_settings import SETTINGS, generate
from llm3_bullet.robots.panda import panda
from llm3_bullet.workcell import Workcell

Times = dict[str, list[float]]
"""Milliseconds by kind of action."""


class Stopwatch:
    """An observer that times the actions of a run."""

    def __init__(self, times: Times) -> None:
        self._times, self._began = times, perf_counter()

    def __call__(self, event: RunEvent) -> None:
        now = perf_counter()
        if isinstance(event, ActionTried):
            outcome = event.outcome
            motion = outcome.failure is None or outcome.failure.kind.is_motion
            if motion and not outcome.reused:
                name = str(outcome.action).partition("(")[0]
                self._times.setdefault(name, []).append(1000 * (now - self._began))
        if isinstance(event, ActionTried | ReplyRead):
            self._began = perf_counter()


def solved(registry: Registry, setting: str, seed: int, times: Times) -> Result:
    """One run with the offline stand-in."""
    with assemble(registry, RunConfig("boxpack", setting=setting, seed=seed)) as run:
        return run.solve(Stopwatch(times))


def resets(timed: int) -> list[float]:
    """Milliseconds of setting the initial state of another problem and showing it to the collision checker."""
    cell = Workcell(panda())
    envs = [BoxpackEnv(generate(setting, seed), cell) for seed in range(timed) for setting in SETTINGS]
    times = []
    for env in envs * 2:
        began = perf_counter()
        cell.checker.narrowphase.show(env.scene(env.reset()))
        times.append(1000 * (perf_counter() - began))
    cell.close()
    return times[len(envs) :]


def table(heads: Sequence[str], rows: Sequence[Sequence[object]]) -> Iterator[str]:
    """A table in Markdown."""
    yield f"| {' | '.join(heads)} |"
    yield f"|{'---|' * len(heads)}"
    for row in rows:
        yield f"| {' | '.join(map(str, row))} |"


def time_rows(times: Mapping[str, Sequence[float]]) -> list[tuple[object, ...]]:
    """Count, median and 90th percentile of each kind."""
    return [
        (name, len(values), *(f"{np.percentile(values, p):.1f}" for p in (50, 90))) for name, values in times.items()
    ]


def run_rows(runs: Mapping[str, Sequence[Result]]) -> Iterator[tuple[object, ...]]:
    """For each setting: how many runs were solved, the mean counts of those, and the seeds that were missed."""
    for setting, results in runs.items():
        done = [result for result in results if result.solved]
        counts = ([r.stats.llm_calls for r in done], [r.stats.motion_calls for r in done])
        missed = ", ".join(str(seed) for seed, result in enumerate(results) if not result.solved)
        means = (f"{np.mean(values):.1f}" if values else "" for values in counts)
        yield (setting, f"{len(done)}/{len(results)}", *means, missed or "none")


def main() -> None:
    """Measure, and write the tables to stdout."""
    parser = argparse.ArgumentParser(description=__doc__.partition("\n")[0])
    parser.add_argument("--seeds", type=int, default=10, help="seeds of each setting that are run (default: 10)")
    parser.add_argument("--timed", type=int, default=5, help="seeds of each setting that are timed (default: 5)")
    arguments = parser.parse_args()
    registry = Registry.discover()
    solved(registry, SETTINGS[0], 0, {})
    times: Times = {}
    runs: dict[str, list[Result]] = {}
    for setting in SETTINGS:
        for seed in range(arguments.seeds):
            result = solved(registry, setting, seed, times if seed < arguments.timed else {})
            runs.setdefault(setting, []).append(result)
    all_actions = [value for name in sorted(times) for value in times[name]]
    timed = {**times, "either": all_actions, "reset": resets(arguments.timed)}
    lines = [
        *table(("what", "count", "median ms", "p90 ms"), time_rows(timed)),
        "",
        *table(("setting", "solved", "model calls", "motion calls", "missed seeds"), list(run_rows(runs))),
    ]
    sys.stdout.write("\n".join(lines) + "\n")


if __name__ == "__main__":
    main()
