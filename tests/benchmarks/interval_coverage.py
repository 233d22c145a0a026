"""How often 95 % intervals for a mean hold the true mean, on data like those of experiments: a table in Markdown.

    OMP_NUM_THREADS=1 OPENBLAS_NUM_THREADS=1 python tests/benchmarks/interval_coverage.py [--samples 4000]

The data are geometric with a cap, as the model calls of runs that end at 20, and lognormal, as seconds. The true mean
of the capped data is that of the capped data. After each coverage stands the interval's mean width, in parts of the
width of Student's t. `llm3 results` uses that of the last column.
"""

from __future__ import annotations

import argparse
import sys
from collections.abc import Callable, Iterator, Mapping

import numpy as np
from numpy.typing import NDArray
from scipy.special import ndtr, ndtri, stdtrit

from llm3.results.means import mean_estimate
from llm3.seeding import generator

Array = NDArray[np.float64]
LEVELS = (0.025, 0.975)
CAP = 20
RESAMPLES = 2000


def geometric(chance: float) -> tuple[Callable[[np.random.Generator, int], Array], float]:
    """Draws of attempts until one works, 20 at most, and their mean."""
    mean = sum((1 - chance) ** k for k in range(CAP))
    return lambda rng, n: np.minimum(rng.geometric(chance, n), CAP).astype(float), mean


def lognormal(sigma: float) -> tuple[Callable[[np.random.Generator, int], Array], float]:
    """Draws with a long tail, and their mean."""
    return lambda rng, n: rng.lognormal(0.0, sigma, n), float(np.exp(sigma**2 / 2))


DATA = {
    "geometric, 0.5": geometric(0.5),
    "geometric, 0.1": geometric(0.1),
    "geometric, 0.03": geometric(0.03),
    "lognormal, 0.5": lognormal(0.5),
    "lognormal, 1": lognormal(1.0),
}


def student(x: Array, _rng: np.random.Generator) -> Array:
    """No bootstrap at all."""
    return np.asarray(x.mean() + stdtrit(x.size - 1, LEVELS) * x.std(ddof=1) / np.sqrt(x.size))


def resampled(x: Array, rng: np.random.Generator) -> Array:
    """(RESAMPLES, n)."""
    return x[rng.integers(x.size, size=(RESAMPLES, x.size), dtype=np.int32)]


def percentile(x: Array, rng: np.random.Generator) -> Array:
    """The middle 95 % of the means of resamples."""
    return np.quantile(resampled(x, rng).mean(1), LEVELS)


def bca(x: Array, rng: np.random.Generator) -> Array:
    """Corrected for bias and acceleration (Efron 1987)."""
    means = resampled(x, rng).mean(1)
    below = (np.mean(means < x.mean()) + np.mean(means <= x.mean())) / 2
    if not 0 < below < 1 or not x.std():
        return np.quantile(means, LEVELS)
    bias, left = ndtri(below), x.mean() - x
    acceleration = -np.sum(left**3) / (6 * np.sum(left**2) ** 1.5)
    z = bias + ndtri(LEVELS)
    return np.quantile(means, ndtr(bias + z / (1 - acceleration * z)))


def studentized(x: Array, rng: np.random.Generator) -> Array:
    """The bootstrap-t; resamples whose values are all equal are left out."""
    again = resampled(x, rng)
    error = again.std(1, ddof=1) / np.sqrt(x.size)
    if not (error > 0).any():
        return np.full(2, x.mean())
    t = (again.mean(1) - x.mean())[error > 0] / error[error > 0]
    return np.asarray(x.mean() - np.quantile(t, LEVELS[::-1]) * x.std(ddof=1) / np.sqrt(x.size))


def ours(x: Array, _rng: np.random.Generator) -> Array:
    """What the program prints."""
    return np.array(mean_estimate(x).interval)


METHODS: Mapping[str, Callable[[Array, np.random.Generator], Array]] = {
    "Student's t": student,
    "percentile": percentile,
    "BCa": bca,
    "studentized": studentized,
    "expanded percentile (llm3)": ours,
}


def coverage(samples: int, n: int, data: str) -> Iterator[tuple[float, float]]:
    """For each method how often the interval holds the true mean, and its mean width."""
    draw, mean = DATA[data]
    rng = generator("interval coverage", n, data)
    kept = [draw(rng, n) for _ in range(samples)]
    for method in METHODS.values():
        low, high = np.array([method(x, rng) for x in kept]).T
        yield float(np.mean((low <= mean + 1e-9) & (mean - 1e-9 <= high))), float(np.mean(high - low))


def main() -> None:
    """Measure, and write the table to stdout."""
    parser = argparse.ArgumentParser(description=__doc__.partition("\n")[0])
    parser.add_argument("--samples", type=int, default=4000, help="of each kind (default: 4000)")
    samples = parser.parse_args().samples
    lines = [f"| data | {' | '.join(METHODS)} |", "|---" * (len(METHODS) + 1) + "|"]
    for data in DATA:
        for n in (10, 50):
            found = list(coverage(samples, n, data))
            cells = (f"{100 * held:.1f} ({width / found[0][1]:.2f})" for held, width in found)
            lines.append(f"| {data}, n = {n} | {' | '.join(cells)} |")
    sys.stdout.write("\n".join(lines) + "\n")


if __name__ == "__main__":
    main()
