"""Things that are not to be packed stand in the tray and around the boxes: some have to be moved away first."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

from llm3_boxpack.families.draft import Draft
from llm3_boxpack.families.filling import Filling
from llm3_boxpack.families.hand import Hand
from llm3_boxpack.families.packing import packed
from llm3_boxpack.families.shapes import drawn_things
from llm3_boxpack.families.spots import FARTHEST, flush
from llm3_boxpack.families.standing import Standing
from llm3_boxpack.families.starts import spread

FILLING = Filling()


def clutter(count: int, hand: Hand, rng: np.random.Generator) -> Draft | None:
    """So many boxes, half as many things in the tray, and as many beside boxes that cannot be taken because of them.

    The things go aside first; None where there is no spot for one of them.
    """
    filled = FILLING.drawn(count, hand, rng)
    if filled is None:
        return None
    tray, packing = filled
    things = drawn_things(2 * (count // 2), rng)
    inside = packed(things[::2], tray, hand, rng)
    boxes = spread(packing, (*tray.walls, *packing, *inside), hand, rng)
    if boxes is None or len(inside) < len(things[::2]):
        return None
    beside = _beside(things[1::2], boxes, (*tray.walls, *inside), hand, rng)
    if beside is None:
        return None
    there = (*tray.walls, *packing, *inside)
    aside = spread((*beside, *reversed(inside)), there, hand, rng, leave=(*boxes, *beside))
    return Draft(tray, boxes, (*aside, *packing), (*beside, *inside)) if aside else None


def _beside(
    things: Sequence[Standing],
    boxes: Sequence[Standing],
    there: Sequence[Standing],
    hand: Hand,
    rng: np.random.Generator,
) -> tuple[Standing, ...] | None:
    """Spots for things from which they can be taken, each so close to a box of its own that this one cannot."""
    done: list[Standing] = []
    for thing, index in zip(things, rng.permutation(len(boxes)).tolist(), strict=False):
        box = boxes[index]
        spots = [
            way.at(x, y)
            for way in (thing.raised(0.0), thing.raised(0.0).turned())
            for x, y in flush(way, (box,), (-FARTHEST, -FARTHEST), (FARTHEST, FARTHEST), hand).tolist()
        ]
        good = [spot for spot in spots if hand.in_the_way(box, (spot,)) and hand.is_free(spot, (*there, *boxes, *done))]
        if not good:
            return None
        done.append(good[int(rng.integers(len(good)))])
    return tuple(done)
