"""Where the names of things stand in a drawing, so that none covers another."""

from __future__ import annotations

from collections.abc import Iterable, Iterator
from dataclasses import dataclass

WIDTH, LINE = 0.62, 1.15
"""Of a letter and of a line, as parts of the size of the text."""
ROWS = (0, -1, 1, -2, 2, -3, 3)
"""In lines from the middle of a thing: where its name may stand, the best place first."""


@dataclass(frozen=True)
class Label:
    """A name and where its middle stands, in the units of the drawing."""

    name: str
    x: float
    y: float


def labels(things: Iterable[tuple[str, float, float]], size: float, left: float, right: float) -> Iterator[Label]:
    """A place for each name: on its thing, or else a few lines above or below it.

    Args:
        things: Names, and where the middles of the things are.
        size: Of the text.
        left: Where the drawing begins; no name crosses that, nor its other end.
        right: Where it ends.
    """
    taken: list[tuple[float, float, float]] = []  # middle and half of the width
    for name, x, y in things:
        half = min(len(name) * WIDTH * size, right - left) / 2
        middle = min(max(x, left + half), right - half)
        rows = [y + row * LINE * size for row in ROWS]
        free = [row for row in rows if not any(_cover((middle, row, half), other, size) for other in taken)]
        row = free[0] if free else y
        taken.append((middle, row, half))
        yield Label(name, middle, row)


def _cover(one: tuple[float, float, float], other: tuple[float, float, float], size: float) -> bool:
    return abs(one[0] - other[0]) < one[2] + other[2] and abs(one[1] - other[1]) < LINE * size * 0.99
