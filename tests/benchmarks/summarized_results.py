"""How long `llm3 results` takes for 10,000 results, from the start of the process to its end: a table in Markdown.

OMP_NUM_THREADS=1 OPENBLAS_NUM_THREADS=1 python tests/benchmarks/summarized_results.py [--times 5]
"""

from __future__ import annotations

import argparse
import subprocess
import sys
from pathlib import Path
from tempfile import TemporaryDirectory
from time import perf_counter

import numpy as np

sys.path.append(str(Path(__file__).parents[1] / "results"))
from experiment_folders import capped, experiment, write

SHAPES = ((4, 6, 417), (2, 1, 5000), (1, 1, 10_000))
"""Methods, problems, seeds."""


def seconds(folder: Path) -> float:
    """Of one process."""
    began = perf_counter()
    subprocess.run([sys.executable, "-m", "llm3", "results", str(folder)], check=True, stdout=subprocess.DEVNULL)
    return perf_counter() - began


def main() -> None:
    """Measure, and write the table to stdout."""
    parser = argparse.ArgumentParser(description=__doc__.partition("\n")[0])
    parser.add_argument("--times", type=int, default=5, help="how often each is measured (default: 5)")
    times = parser.parse_args().times
    rng = np.random.default_rng(0)
    sys.stdout.write("| methods | problems | seeds | results | median s |\n|---|---|---|---|---|\n")
    for methods, problems, seeds in SHAPES:
        made = experiment(map("method {}".format, range(methods)), map("problem {}".format, range(problems)), seeds)
        runs = [
            run
            for method in made.methods
            for problem in made.problems
            for run in capped(method.name, problem.name, rng.geometric(0.1, seeds).tolist())
        ]
        with TemporaryDirectory() as folder:
            write(Path(folder), made, runs)
            median = np.median([seconds(Path(folder)) for _ in range(times)])
        sys.stdout.write(f"| {methods} | {problems} | {seeds:,} | {len(runs):,} | {median:.1f} |\n")


if __name__ == "__main__":
    main()
