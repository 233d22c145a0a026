"""A long tray of which only the nearer part is within reach: everything fits if that part is used well."""

from __future__ import annotations

import numpy as np

from llm3_boxpack.families.dense import from_around
from llm3_boxpack.families.draft import Draft
from llm3_boxpack.families.filling import Filling
from llm3_boxpack.families.hand import Hand
from llm3_boxpack.families.spots import FARTHEST
from llm3_boxpack.families.tray import Tray

BEYOND = 160.0
"""How much of the tray is too far away, in millimetres."""


def far(count: int, hand: Hand, rng: np.random.Generator) -> Draft | None:
    """So many boxes, each with room around it at the start; None where the draft came to nothing."""
    return from_around(FILLING, count, hand, rng)


def _far_away(depth: float, width: float) -> Tray:
    """A tray of which so much is near enough for the centre of a box."""
    return Tray((FARTHEST - depth, -width / 2), (FARTHEST + BEYOND, width / 2))


FILLING = Filling(tray=_far_away)
