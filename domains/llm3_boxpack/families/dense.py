"""Many boxes and a tray that is just large enough: order, rotation and room for the open fingers decide."""

from __future__ import annotations

import numpy as np

from llm3_boxpack.families.draft import Draft
from llm3_boxpack.families.filling import Filling
from llm3_boxpack.families.hand import Hand
from llm3_boxpack.families.starts import spread

FILLING = Filling()


def dense(count: int, hand: Hand, rng: np.random.Generator) -> Draft | None:
    """So many boxes, each with room around it at the start; None where the draft came to nothing."""
    return from_around(FILLING, count, hand, rng)


def from_around(filling: Filling, count: int, hand: Hand, rng: np.random.Generator) -> Draft | None:
    """A tray and boxes that start around it, each with room for the hand; None where the table has too little of it."""
    filled = filling.drawn(count, hand, rng)
    if filled is None:
        return None
    tray, packing = filled
    start = spread(packing, (*tray.walls, *packing), hand, rng)
    return Draft(tray, start, packing) if start else None
