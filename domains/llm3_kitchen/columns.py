"""Fills the store where a solution has to be known: columns of things that stand close behind one another.

The columns are side by side along y, each from the front of the store to its back, and what stands in one has a long
side in front. Fingers that take food need room in front of it and behind it, which is where clutter stands.
"""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Mapping, Sequence
from math import cos, pi, sin

import numpy as np

from llm3_bullet.scene import Size
from llm3_bullet.tabletop.rectangles import Rectangle
from llm3_kitchen.store import ASIDE, SNUG, Spot, footprint, rounded

PITCH = 0.2
"""From the middle of a column to that of the next, in metres: more than the longest food and a finger."""
MOST_TURNED = 0.1
"""How far a column is turned from the x axis, in radians."""


def dealt(foods: Sequence[str], clutter: Iterable[str], count: int) -> list[list[str]]:
    """Names of what stands in each column, from its front to its back.

    Food is dealt in turns. Between any two foods of a column stands something of the clutter, and the rest of it at the
    ends of the columns, in turns: first behind, then in front.

    Args:
        foods: As many as there are columns, at least.
        clutter: At least as much as there are foods but columns, and no more than foods and columns.
        count: Of the columns.
    """
    rest = iter(clutter)
    columns = [[foods[start], *_alternating(rest, foods[start + count :: count])] for start in range(count)]
    for index, name in enumerate(rest):
        column = columns[index % count]
        column.insert(len(column) if index < count else 0, name)
    return columns


def _alternating(clutter: Iterator[str], foods: Iterable[str]) -> Iterator[str]:
    for food in foods:
        yield next(clutter)
        yield food


def standing(
    area: Rectangle, columns: Sequence[Sequence[str]], sizes: Mapping[str, Size], rng: np.random.Generator
) -> dict[str, Spot] | None:
    """Where everything starts; None where a column came to reach out of the store.

    Args:
        area: The store.
        columns: Names from front to back.
        sizes: Of all, by name.
        rng: Draws how close things are, and how far a column is turned and moved.
    """
    spots: dict[str, Spot] = {}
    for index, names in enumerate(columns):
        middle = area.center[1] + PITCH * (index - (len(columns) - 1) / 2)
        spots.update(_column(area, middle, names, sizes, rng))
    inside = all(area.overhang(footprint(spot, sizes[name])) == 0.0 for name, spot in spots.items())
    return spots if inside else None


def _column(
    area: Rectangle, y: float, names: Sequence[str], sizes: Mapping[str, Size], rng: np.random.Generator
) -> Iterator[tuple[str, Spot]]:
    gaps = rng.uniform(*SNUG, len(names))
    depth = sum(sizes[name][1] for name in names) + gaps[1:].sum()
    turn = rng.uniform(-MOST_TURNED, MOST_TURNED)
    play = max(0.0, (area.size[0] - depth) / 2 - MOST_TURNED * ASIDE)
    x, front = area.center[0] + rng.uniform(-play, play), -depth / 2 - gaps[0]
    for name, gap in zip(names, gaps, strict=True):
        deep = front + gap + sizes[name][1] / 2
        aside = rng.uniform(-ASIDE, ASIDE)
        spot = x + deep * cos(turn) - aside * sin(turn), y + deep * sin(turn) + aside * cos(turn)
        yield name, rounded(*spot, turn + pi / 2)
        front += gap + sizes[name][1]
