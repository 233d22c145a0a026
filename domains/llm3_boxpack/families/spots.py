"""Spots for a box among others at which there is room for the hand, too."""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from itertools import product

import numpy as np
from numpy.typing import NDArray

from llm3_boxpack.families.hand import GAP, Hand
from llm3_boxpack.families.standing import Standing

NEAREST, FARTHEST = 430.0, 770.0
"""From the arm's base to the centre of a box, in millimetres. The arm reaches 30 mm farther. Nearer than
this the wrist is at its limit in some directions, so that it depends on how a box was taken whether it can be put down
there."""

Centers = NDArray[np.float64]
"""(K, 2)."""


def flush(
    box: Standing, obstacles: Sequence[Standing], low: tuple[float, float], high: tuple[float, float], hand: Hand
) -> list[Standing]:
    """Where a box is flush with things or walls, a finger away or in line, with room for the hand.

    Args:
        box: Wherever it stands, on what it is to stand on; it is tried as it is and turned by a quarter.
        obstacles: What is there already.
        low: The corner of the area in which the whole box has to stand, with a gap to its border,
        high: and the opposite one.
        hand: What puts the box down.
    """
    found = []
    for turned in (box, box.turned()):
        axes = (
            _along([(t.x, t.dx) for t in obstacles], turned.dx, (low[0], high[0]), hand.room),
            _along([(t.y, t.dy) for t in obstacles], turned.dy, (low[1], high[1]), hand.room),
        )
        centers = within_reach(np.array(list(product(*axes)), dtype=float).reshape(-1, 2))
        found += [turned.at(x, y) for x, y in centers[hand.free(turned, centers, obstacles)].tolist()]
    return found


def is_within_reach(box: Standing) -> bool:
    """Whether the arm reaches a box for sure, however it has been taken."""
    return NEAREST <= box.distance <= FARTHEST


def within_reach(centers: Centers) -> Centers:
    """Those that the arm reaches for sure."""
    radius = np.hypot(centers[:, 0], centers[:, 1])
    return centers[(radius >= NEAREST) & (radius <= FARTHEST)]


def _along(
    obstacles: Iterable[tuple[float, float]], side: float, ends: tuple[float, float], finger: float
) -> list[float]:
    """Coordinates along one axis."""
    found = {ends[0] + side / 2 + GAP, ends[1] - side / 2 - GAP}
    for center, length in obstacles:
        beside = (length + side) / 2
        found |= {center + offset for gap in (GAP, finger) for offset in (-beside - gap, 0.0, beside + gap)}
    return sorted(at for at in found if ends[0] + side / 2 + GAP <= at <= ends[1] - side / 2 - GAP)
