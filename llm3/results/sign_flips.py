"""An exact test of paired differences."""

from __future__ import annotations

from collections.abc import Iterable

import numpy as np
from numpy.typing import NDArray

from llm3.seeding import generator

EXACT_STEPS = 50_000_000
"""Additions that the exact distribution may take."""
FLIPS = 10_000
_AT_A_TIME = 60_000
"""Signs that are drawn at once: few enough for the processor's cache."""


def sign_flip_test(differences: Iterable[int]) -> float:
    """The two-sided p-value of paired differences under the hypothesis that either sign of each is as likely.

    It is the share of all 2^n choices of signs that bring the sum as far from zero as it is (Fisher 1935). As the
    differences are whole numbers, all choices are counted at once, by their sums (Streitberg and Röhmel 1986). For
    differences of -1, 0 and 1 it is McNemar's exact test. Only where the sums are too many are 10,000 choices drawn,
    and the p-value is that of Phipson and Smyth (2010), which is never 0.

    Args:
        differences: In any order; without any that is not zero, p is 1.
    """
    given = np.array(list(differences), dtype=np.int64)
    sizes = np.sort(np.abs(given[given != 0]))
    if not sizes.size:
        return 1.0
    distance, total = abs(int(given.sum())), int(sizes.sum())
    if sizes.size * total <= EXACT_STEPS:
        return _exact(sizes, distance, total)
    return _drawn(sizes, distance)


def _exact(sizes: NDArray[np.int64], distance: int, total: int) -> float:
    chances = np.zeros(total + 1)  # of what the positive ones add up to
    chances[0], reach = 1.0, 0
    for size in sizes.tolist():
        half = chances[: reach + 1] / 2
        chances[: reach + 1] = half
        chances[size : reach + size + 1] += half
        reach += size
    sums = 2 * np.arange(total + 1) - total
    return min(1.0, float(chances[np.abs(sums) >= distance].sum()))


def _drawn(sizes: NDArray[np.int64], distance: int) -> float:
    rng = generator("sign flips", sizes.size, int(sizes.sum()))
    as_far, left = 0, FLIPS
    while left:
        rows = min(left, max(1, _AT_A_TIME // sizes.size))
        positive = rng.integers(2, size=(rows, sizes.size), dtype=np.int8) @ sizes.astype(float)
        as_far += int((np.abs(2 * positive - sizes.sum()) >= distance).sum())
        left -= rows
    return (1 + as_far) / (1 + FLIPS)
