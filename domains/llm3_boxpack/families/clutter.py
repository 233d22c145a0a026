"""Things that are not to be packed stand in the tray and around the boxes: some have to be moved away first."""

from __future__ import annotations

import numpy as np

from llm3_boxpack.families.draft import Draft
from llm3_boxpack.families.filling import Filling
from llm3_boxpack.families.hand import Hand
from llm3_boxpack.families.insertion import packed
from llm3_boxpack.families.shapes import drawn_clutter
from llm3_boxpack.families.starts import beside, spread

FILLING = Filling()


def clutter(count: int, hand: Hand, rng: np.random.Generator) -> Draft | None:
    """So many boxes and as many things: half of these in the tray, the others beside boxes that so cannot be taken.

    The things go aside first; None where there is no spot for one of them.
    """
    filled = FILLING.drawn(count, hand, rng)
    if filled is None:
        return None
    tray, packing = filled
    things = drawn_clutter(count, rng)
    inside = packed(things[::2], tray, hand, rng)
    boxes = spread(packing, (*tray.walls, *packing, *inside), hand, rng)
    if boxes is None or len(inside) < len(things[::2]):
        return None
    outside = beside(things[1::2], boxes, (*tray.walls, *inside), hand, rng)
    if outside is None:
        return None
    obstacles = (*tray.walls, *packing, *inside)
    aside = spread((*outside, *reversed(inside)), obstacles, hand, rng, keep_free=(*boxes, *outside))
    return Draft(tray, boxes, (*aside, *packing), (*outside, *inside)) if aside else None
