"""Objects of random sizes at random places."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace
from math import hypot

import numpy as np

from llm3_tabletop2d.instance import ObjectSpec, Pair

APART = 0.12
"""Free space in metres between the circles around two objects: the robot gets through."""
TRIES = 200
"""Places that are drawn for an object before all are drawn anew."""
ROUNDS = 200


def disc(name: str, rng: np.random.Generator, low: float, high: float) -> ObjectSpec:
    """A disc whose diameter is drawn from a range, in metres; it is at the origin."""
    diameter = _drawn(rng, low, high)
    return ObjectSpec(name, "disc", (diameter, diameter), (0.0, 0.0))


def box(name: str, rng: np.random.Generator, sides: Pair, turn: float = 0.0) -> ObjectSpec:
    """A box whose sides are drawn from a range, in metres, turned by 0 to `turn`; it is at the origin."""
    size = _drawn(rng, *sides), _drawn(rng, *sides)
    return ObjectSpec(name, "box", size, (0.0, 0.0), _drawn(rng, 0.0, turn) if turn else 0.0)


def shifted(item: ObjectSpec, position: Pair) -> ObjectSpec:
    """The same object elsewhere."""
    return replace(item, position=position)


def scattered(
    rng: np.random.Generator, items: Sequence[ObjectSpec], area: tuple[Pair, Pair], placed: Sequence[ObjectSpec] = ()
) -> list[ObjectSpec]:
    """The items at random places in an area, `APART` from one another.

    Args:
        rng: Draws the places.
        items: What to put there.
        area: The ranges of x and y, in metres, in which they lie with their whole outlines.
        placed: What they keep away from.
    """
    for _ in range(ROUNDS):
        put: list[ObjectSpec] = []
        for item in items:
            found = _free(rng, item, area, (*placed, *put))
            if found is None:
                break
            put.append(found)
        else:
            return put
    raise ValueError(f"there is no room for {len(items)} objects in {area}")


def _free(
    rng: np.random.Generator, item: ObjectSpec, area: tuple[Pair, Pair], others: Sequence[ObjectSpec]
) -> ObjectSpec | None:
    margin = item.outer_radius
    for _ in range(TRIES):
        x, y = (_drawn(rng, low + margin, high - margin) for low, high in area)
        apart = (hypot(x - other.position[0], y - other.position[1]) - margin - other.outer_radius for other in others)
        if all(gap >= APART for gap in apart):
            return shifted(item, (x, y))
    return None


def _drawn(rng: np.random.Generator, low: float, high: float) -> float:
    return round(float(rng.uniform(low, high)), 3)
