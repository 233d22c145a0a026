"""Puts boxes into a tray one after another, each where it and the hand have room at that moment."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace

import numpy as np

from llm3_boxpack.families.hand import Hand
from llm3_boxpack.families.spots import flush, is_within_reach
from llm3_boxpack.families.standing import Standing
from llm3_boxpack.families.tray import FLOOR, Tray

CHOICE = 4
"""Among how many of the best spots one is drawn."""
GROWTH = 4.0
"""By how much a box grows at once, in whole millimetres to both sides; it is longer than wide by so much at least."""
LONGEST = 140.0
"""Side of a box, in millimetres."""

Packing = tuple[Standing, ...]
"""Boxes where they stand in the tray, in the order in which they are put down."""


def packed(
    boxes: Sequence[Standing], tray: Tray, hand: Hand, rng: np.random.Generator, obstacles: Sequence[Standing] = ()
) -> Packing:
    """Put the boxes into the tray in this order; it ends before the first one that finds no spot.

    Args:
        boxes: Wherever they stand.
        tray: Where they go.
        hand: What puts them down.
        rng: Draws the corner that all of them come close to, and the spots among the best ones.
        obstacles: What is in the way already.
    """
    corner = np.array([tray.low, tray.high])[rng.integers(2, size=2), (0, 1)]
    slant = rng.uniform(0.6, 1.4)
    done: list[Standing] = []
    for box in boxes:
        spots = flush(box.raised(FLOOR), (*tray.walls, *obstacles, *done), tray.low, tray.high, hand)
        if not spots:
            break
        spots.sort(key=lambda spot: abs(spot.x - corner[0]) + slant * abs(spot.y - corner[1]))
        done.append(spots[int(rng.integers(min(CHOICE, len(spots))))])
    return tuple(done)


def grown(boxes: Packing, tray: Tray, hand: Hand, rng: np.random.Generator) -> Packing:
    """Let the boxes of a packing grow into the room between them, as long as it can be done in this order.

    Args:
        boxes: The packing.
        tray: Where they stand.
        hand: What puts them down.
        rng: Draws which side of which box moves next.
    """
    sides = [(index, axis, sign) for index in range(len(boxes)) for axis in (0, 1) for sign in (-1, 1)]
    while sides:
        chosen = int(rng.integers(len(sides)))
        index, axis, sign = sides[chosen]
        larger = _larger(boxes[index], axis, sign * GROWTH / 2, hand)
        wanted = (*boxes[:index], larger, *boxes[index + 1 :]) if larger else ()
        if wanted and _can_be_done(wanted, tray, hand):
            boxes = wanted
        else:
            sides.pop(chosen)
    return boxes


def _larger(box: Standing, axis: int, shift: float, hand: Hand) -> Standing | None:
    """The box with one of its sides moved out; None where the hand would take it another way, or not at all."""
    wider = replace(box, dx=box.dx + GROWTH, x=box.x + shift)
    longer = replace(box, dy=box.dy + GROWTH, y=box.y + shift)
    larger = longer if axis else wider
    short, long = sorted((larger.dx, larger.dy))
    fits = short <= hand.widest and long <= LONGEST and long - short >= GROWTH
    return larger if fits and larger.is_along_y == box.is_along_y and is_within_reach(larger) else None


def _can_be_done(boxes: Packing, tray: Tray, hand: Hand) -> bool:
    return all(tray.holds(box) and hand.is_free(box, (*tray.walls, *boxes[:index])) for index, box in enumerate(boxes))
