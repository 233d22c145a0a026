"""Two workers against one on an experiment that is all motion planning, beside what the machine itself makes of two
processes. A table in Markdown.

    export OMP_NUM_THREADS=1 OPENBLAS_NUM_THREADS=1
    python tests/benchmarks/two_workers.py [--runs 60] [--calls 20] [--repeats 3]

Both ratios are seconds with two processes over seconds with one, for the same amount of work; 0.5 is the best there is.

- The machine's: one process that solves one problem again and again in one world, with nothing of experiments, and
  two such processes side by side, each of which does as much as the one. Seconds of two, over twice the seconds of one.
  What is missing to 0.5 is due to the machine: cores that share caches and memory, and slow down together, and other
  people's work. Starting is not counted.
- The experiment's: as many runs, with their records, from starting the workers to their end.
  Seconds with two workers, over seconds with one.

The experiment's ratio over the machine's is what the experiment adds. One repeat measures all four, one after the
other; the table has the medians. Whoever else works on the machine spoils it.
"""

from __future__ import annotations

import argparse
import multiprocessing
import statistics
import sys
from dataclasses import dataclass
from multiprocessing.synchronize import Barrier
from pathlib import Path
from tempfile import TemporaryDirectory
from time import perf_counter

from llm3.assembly import RunConfig, assemble
from llm3.experiments import Experiment, ExperimentWriter, Method, ProblemFamily, missing_jobs, run_experiment
from llm3.experiments.workers import SpawnedWorkers
from llm3.registry import Registry


@dataclass(frozen=True)
class Measured:
    """Seconds of one repeat."""

    alone: float
    side_by_side: float
    """Of two processes, each of which does as much as the one that is alone."""
    one_worker: float
    two_workers: float

    @property
    def machine(self) -> float:
        """The ratio of two processes to one."""
        return self.side_by_side / (2 * self.alone)

    @property
    def experiment(self) -> float:
        """The ratio of two workers to one."""
        return self.two_workers / self.one_worker

    @property
    def added(self) -> float:
        """What the experiment adds to the machine's ratio."""
        return self.experiment / self.machine


def an_experiment(runs: int, calls: int) -> Experiment:
    """The paper's random row with a cap so low that hardly any run is solved: all runs take about as long."""
    problem = ProblemFamily("hard-small", "boxpack", "hard-small")
    settings = {"llm": "random", "timing": "none", "max_llm_calls": calls}
    return Experiment("two-workers", "", tuple(range(runs)), (problem,), (Method("random", "random", settings),))


def load(config: RunConfig, times: int, start: Barrier, end: Barrier) -> None:
    """Solve one problem so many times, in a process of its own."""
    with assemble(Registry.discover(), config) as run:
        run.solve()  # imports what there is to import
        start.wait()
        for _ in range(times):
            run.solve()
        end.wait()


def seconds_of_processes(config: RunConfig, times: int, count: int) -> float:
    """How long so many processes take, each of which does the same."""
    context = multiprocessing.get_context("spawn")
    start, end = context.Barrier(count + 1), context.Barrier(count + 1)
    processes = [context.Process(target=load, args=(config, times, start, end), daemon=True) for _ in range(count)]
    for process in processes:
        process.start()
    start.wait()
    began = perf_counter()
    end.wait()
    seconds = perf_counter() - began
    for process in processes:
        process.join()
    return seconds


def seconds_of_experiment(experiment: Experiment, count: int) -> float:
    """How long an experiment takes with so many workers."""
    with TemporaryDirectory() as folder, ExperimentWriter(Path(folder, "out"), experiment, {}) as writer:
        jobs = missing_jobs(experiment, writer.ended)
        began = perf_counter()
        with SpawnedWorkers(count) as workers:
            run_experiment(jobs, writer, workers, count, limits={}, watcher=lambda _: None)
        seconds = perf_counter() - began
        statuses = {line.status for line in writer.ended.values()}
    if not statuses <= {"solved", "not solved"}:
        raise SystemExit(f"runs ended as {', '.join(sorted(statuses))}")
    return seconds


def measure(runs: int, calls: int) -> Measured:
    """Measure all four, one after the other."""
    experiment = an_experiment(runs, calls)
    config = next(experiment.jobs()).config
    return Measured(
        seconds_of_processes(config, runs, 1),
        seconds_of_processes(config, runs, 2),
        seconds_of_experiment(experiment, 1),
        seconds_of_experiment(experiment, 2),
    )


def table(repeats: list[Measured]) -> str:
    """The medians, in Markdown."""

    def median(name: str) -> float:
        return statistics.median(getattr(repeat, name) for repeat in repeats)

    return (
        "| | one, s | two, s | two over one |\n|---|---|---|---|\n"
        f"| processes with nothing between them (two do twice the work) | {median('alone'):.1f} | "
        f"{median('side_by_side'):.1f} | {median('machine'):.3f} |\n"
        f"| workers of an experiment | {median('one_worker'):.1f} | {median('two_workers'):.1f} | "
        f"{median('experiment'):.3f} |\n\n"
        f"The experiment's ratio is {median('added'):.3f} times the machine's "
        f"({', '.join(f'{repeat.added:.3f}' for repeat in repeats)}).\n"
    )


def main() -> None:
    """Measure, and write the table to stdout."""
    parser = argparse.ArgumentParser(description=__doc__.partition("\n\n")[0])
    parser.add_argument("--runs", type=int, default=60, help="how many (default: 60)")
    parser.add_argument("--calls", type=int, default=20, help="proposals of a run (default: 20)")
    parser.add_argument("--repeats", type=int, default=3, help="how often (default: 3)")
    arguments = parser.parse_args()
    sys.stdout.write(table([measure(arguments.runs, arguments.calls) for _ in range(arguments.repeats)]))


if __name__ == "__main__":
    main()
