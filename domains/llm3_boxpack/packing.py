"""Choosing a spot for a box among others: the rules of thumb of the stand-in."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from math import hypot, pi

import numpy as np

EDGE_MARGIN = 0.004
"""A box is planned at least this far inside of the basket, in metres."""
SAMPLES = 400
JITTER = 0.01
"""How far chance may outweigh tightness, in metres."""
SAME_SPOT = 0.02
"""A spot closer than this to one that failed, in metres, is not tried again."""


@dataclass(frozen=True)
class Spot:
    """A box in the basket, its sides parallel to x and y. Lengths in metres, theta in radians."""

    x: float
    y: float
    theta: float
    size: tuple[float, float]
    """What it covers along the world's x and y."""


@dataclass(frozen=True)
class Wishes:
    """What experience asks of the next spot."""

    gap: float
    """Free space beside a box in metres."""
    reach: float
    """Distance from the arm's base that seems out of reach, in metres."""
    failed: tuple[tuple[float, float], ...]
    """Where this box could not be put."""


def choose_spot(
    basket: tuple[tuple[float, float], tuple[float, float]],
    size: tuple[float, float],
    others: Sequence[Spot],
    wishes: Wishes,
    rng: np.random.Generator,
) -> Spot:
    """A spot that fits the wishes or, where there is none, comes close to them: snug in a corner, or beside a box.

    Args:
        basket: Its inside: the ranges along x and y in metres.
        size: The box's sides in metres.
        others: What stands in the basket already.
        wishes: What experience asks for.
        rng: Chooses among good spots.
    """
    candidates = [_draw(basket, size, rng) for _ in range(SAMPLES)]
    near = [c for c in candidates if hypot(c.x, c.y) < wishes.reach] or candidates
    fresh = [c for c in near if all(hypot(c.x - x, c.y - y) > SAME_SPOT for x, y in wishes.failed)] or near
    gap = wishes.gap
    roomy: list[Spot] = []
    while not roomy and gap > 0.002:
        roomy = [c for c in fresh if all(_apart(c, other) >= gap for other in others)]
        gap *= 0.8
    good = roomy or fresh
    return min(good, key=lambda c: _looseness(c, others, basket) + rng.uniform(0.0, JITTER))


def _draw(
    basket: tuple[tuple[float, float], tuple[float, float]], size: tuple[float, float], rng: np.random.Generator
) -> Spot:
    turned = size[0] != size[1] and rng.random() < 0.5
    covers = (size[1], size[0]) if turned else size
    x, y = (
        float(rng.uniform(low + half, high - half)) if high - low > 2 * half else (low + high) / 2
        for (low, high), half in zip(basket, (side / 2 + EDGE_MARGIN for side in covers), strict=True)
    )
    return Spot(round(x, 3), round(y, 3), round(pi / 2, 3) if turned else 0.0, covers)


def _apart(a: Spot, b: Spot) -> float:
    """Free space between two boxes in metres, along the axis on which there is more of it."""
    return max(abs(a.x - b.x) - (a.size[0] + b.size[0]) / 2, abs(a.y - b.y) - (a.size[1] + b.size[1]) / 2)


def _looseness(spot: Spot, others: Sequence[Spot], basket: tuple[tuple[float, float], tuple[float, float]]) -> float:
    """How far the box is from being packed tightly, in metres: from a corner, or from the nearest other box."""
    if not others:
        return _to_corner(spot, basket)
    return min(_to_corner(spot, basket) / 2 + _apart(spot, other) for other in others)


def _to_corner(spot: Spot, basket: tuple[tuple[float, float], tuple[float, float]]) -> float:
    """How far the box is from the basket's nearest corner in metres, summed over x and y."""
    sides = zip((spot.x, spot.y), spot.size, basket, strict=True)
    return sum(min(p - low, high - p) - side / 2 for p, side, (low, high) in sides)
