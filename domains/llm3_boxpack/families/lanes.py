"""Boxes that start so close together that most of them can only be taken when others are gone."""

from __future__ import annotations

import numpy as np

from llm3_boxpack.families.draft import Draft
from llm3_boxpack.families.filling import Filling
from llm3_boxpack.families.hand import Hand
from llm3_boxpack.families.shapes import ALIKE
from llm3_boxpack.families.starts import crowded

FILLING = Filling(heights=ALIKE, before=0.4, covered=0.48)
"""With boxes of nearly one height, over which no finger passes, a tray cannot be as full as with others."""
LOW, HIGH = (0.0, 330.0), (440.0, 720.0)
"""Two corners of where they start on the arm's left side, in millimetres; its right side has the same mirrored."""
BLOCKED = 0.5
"""The share of the boxes that cannot be taken at first, at least."""


def lanes(count: int, hand: Hand, rng: np.random.Generator) -> Draft | None:
    """So many boxes, half of them on each side of the arm; None where they do not come to stand close enough."""
    filled = FILLING.drawn(count, hand, rng)
    if filled is None:
        return None
    tray, packing = filled
    around = (*tray.walls, *packing)
    left = crowded(packing[::2], around, LOW, HIGH, hand, rng)
    right = crowded(packing[1::2], around, (LOW[0], -HIGH[1]), (HIGH[0], -LOW[1]), hand, rng)
    if left is None or right is None:
        return None
    draft = Draft(tray, (*left, *right), packing)
    return draft if len(draft.blocked_picks(hand)) >= BLOCKED * count else None
