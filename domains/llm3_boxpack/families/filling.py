"""Fills a tray: boxes are drawn, a tray is cut to them, and they are packed and grow until they cover most of it."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass

import numpy as np

from llm3_boxpack.families.hand import Hand
from llm3_boxpack.families.insertion import Packing, grown, packed
from llm3_boxpack.families.shapes import MIXED, Heights, drawn_boxes, from_low_to_tall
from llm3_boxpack.families.tray import Tray

SQUARENESS = (0.8, 1.25)
"""The ratio of a tray's sides."""
FRONT = 420.0
"""From the arm's base to the nearer end of a tray in front of it, in millimetres."""


def in_front(depth: float, width: float) -> Tray:
    """A tray of this size in front of the arm, all of it within reach."""
    return Tray((FRONT, -width / 2), (FRONT + depth, width / 2))


@dataclass(frozen=True)
class Filling:
    """How full a tray gets."""

    heights: Heights = MIXED
    """Of the boxes."""
    before: float = 0.5
    """Which part of it the boxes cover when they are packed, before they grow …"""
    covered: float = 0.58
    """… and afterwards, at least."""
    tray: Callable[[float, float], Tray] = in_front
    """The tray whose part in use has this depth, along x, and this width."""

    def drawn(self, count: int, hand: Hand, rng: np.random.Generator) -> tuple[Tray, Packing] | None:
        """A tray, and a packing of so many boxes in it; None where those that were drawn do not come to cover it."""
        boxes = drawn_boxes(count, self.heights, rng)
        area = sum(box.area for box in boxes) / self.before
        width = 2 * round((area * rng.uniform(*SQUARENESS)) ** 0.5 / 2)
        depth = 2 * round(area / width / 2)
        tray = self.tray(depth, width)
        packing = packed(from_low_to_tall(boxes, rng), tray, hand, rng)
        if len(packing) < count:
            return None
        packing = grown(packing, tray, hand, rng)
        return (tray, packing) if sum(box.area for box in packing) >= self.covered * depth * width else None
