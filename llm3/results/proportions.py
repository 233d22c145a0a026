"""Shares of runs that succeeded, and the differences of two such shares."""

from __future__ import annotations

from math import sqrt
from statistics import NormalDist

from llm3.results.estimates import LEVEL, Estimate

Z = NormalDist().inv_cdf((1 + LEVEL) / 2)


def share_estimate(successes: int, n: int) -> Estimate:
    """A share with Wilson's score interval (Wilson 1927; Brown, Cai and DasGupta 2001).

    Args:
        successes: How many of them.
        n: How many there are; at least 1.
    """
    share = successes / n
    center = (share + Z**2 / (2 * n)) / (1 + Z**2 / n)
    half = Z * sqrt(share * (1 - share) / n + Z**2 / (4 * n**2)) / (1 + Z**2 / n)
    low, high = center - half, center + half
    return Estimate(n, share, (low if successes else 0.0, high if successes < n else 1.0))  # not 1e-17 beside them


def paired_share_difference(only_first: int, only_second: int, n: int) -> Estimate:
    """How much greater the share of the first of two methods is that tried the same problems.

    The interval is the adjusted Wald interval of Bonett and Price (2012). Its middle is not quite the difference: it
    is drawn towards zero, which is what makes the interval good for few pairs.

    Args:
        only_first: Pairs in which the first succeeded and the second did not.
        only_second: Pairs in which it was the other way round.
        n: All pairs; at least 1.
    """
    first, second = (only_first + 1) / (n + 2), (only_second + 1) / (n + 2)
    center = first - second
    half = Z * sqrt((first + second - center**2) / (n + 2))
    return Estimate(n, (only_first - only_second) / n, (max(center - half, -1.0), min(center + half, 1.0)))
