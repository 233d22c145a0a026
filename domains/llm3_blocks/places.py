"""Choosing a place for a block on the table among others: the rules of thumb of the stand-in."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from math import dist, hypot, inf

import numpy as np

Point = tuple[float, float]

SAMPLES = 400
AROUND = 0.2
"""Places are looked for where blocks stand, and so far around, in metres."""
JITTER = 0.02
"""How far chance may outweigh nearness, in metres."""
SAME_PLACE = 0.03
"""A place closer than this to one that failed, in metres, is not tried again."""


@dataclass(frozen=True)
class Spot:
    """Where a block stands. Lengths in metres."""

    center: Point
    radius: float
    """Of a circle around the block, seen from above."""


@dataclass(frozen=True)
class Wishes:
    """What experience asks of the next place."""

    gap: float
    """Free space around a block in metres."""
    reach: float = inf
    """Distance from the arm's base that seems out of reach, in metres."""
    failed: tuple[Point, ...] = ()
    """Where something could not be put."""


def free_place(radius: float, others: Sequence[Spot], wishes: Wishes, rng: np.random.Generator) -> Spot:
    """A place that fits the wishes or, where there is none, comes close to them: not far from where the others stand.

    Args:
        radius: Of the block.
        others: What stands on the table, and will stand there; at least one.
        wishes: What experience asks for.
        rng: Chooses among good places.
    """
    centers = np.array([other.center for other in others])
    low, high = centers.min(axis=0) - AROUND, centers.max(axis=0) + AROUND
    low, high = np.maximum(low, (0.0, -1.0)), np.minimum(high, (1.0, 1.0))
    candidates = [Spot((x, y), radius) for x, y in rng.uniform(low, high, (SAMPLES, 2)).round(3).tolist()]
    near = [c for c in candidates if hypot(*c.center) < wishes.reach] or candidates
    fresh = [c for c in near if all(dist(c.center, f) > SAME_PLACE for f in wishes.failed)] or near
    gap = wishes.gap
    roomy: list[Spot] = []
    while not roomy and gap > 0.005:
        roomy = [c for c in fresh if all(_apart(c, other) >= gap for other in others)]
        gap *= 0.8
    middle = centers.mean(axis=0)
    return min(roomy or fresh, key=lambda c: dist(c.center, middle) + rng.uniform(0.0, JITTER))


def _apart(a: Spot, b: Spot) -> float:
    return dist(a.center, b.center) - a.radius - b.radius
