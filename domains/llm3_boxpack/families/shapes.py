"""What is to be packed: boxes of three heights, each of a colour of its own, and grey things that are not."""

from __future__ import annotations

import numpy as np

from llm3_boxpack.families.standing import Standing

COLORS = (
    "red",
    "blue",
    "green",
    "yellow",
    "orange",
    "purple",
    "cyan",
    "tan",
    "pink",
    "brown",
    "white",
    "black",
)
CLUTTER = (
    "paint_can",
    "glue_can",
    "screw_tin",
    "tape_case",
    "lamp_base",
    "wire_spool",
    "wax_tin",
    "oil_can",
    "salt_tub",
    "soap_case",
    "drill_case",
    "bolt_tin",
)
Heights = tuple[tuple[float, ...], ...]
"""Kinds of heights, in millimetres, each of which some boxes have."""
MIXED: Heights = ((26.0, 30.0), (56.0, 60.0, 64.0), (80.0, 84.0, 90.0))
"""The fingers around a tall box, and around most others, pass over a low one; the palm above a low box does not pass
over a tall one."""
ALIKE: Heights = ((56.0, 60.0), (64.0, 66.0), (70.0, 74.0))
"""No finger passes over another box, and the palm always does."""
SHORT = (30.0, 34.0, 40.0, 44.0, 50.0, 54.0, 60.0)
LONGER_BY = (10.0, 14.0, 20.0, 30.0, 40.0, 50.0)
"""In millimetres: no box is square, so that there is one way to take it. All lengths are even, so that centres and
sides are whole numbers."""


def drawn_boxes(count: int, heights: Heights, rng: np.random.Generator) -> tuple[Standing, ...]:
    """So many boxes, with each kind of height among them, in random order."""
    kinds = rng.permutation([index % len(heights) for index in range(count)]).tolist()
    return tuple(_shape(f"{color}_box", heights[kind], rng) for color, kind in zip(COLORS[:count], kinds, strict=True))


def drawn_clutter(count: int, rng: np.random.Generator) -> tuple[Standing, ...]:
    """So many things of middle height or tall, all of them as long and as wide as small boxes."""
    return tuple(_shape(name, MIXED[int(rng.integers(1, 3))], rng) for name in CLUTTER[:count])


def _shape(name: str, heights: tuple[float, ...], rng: np.random.Generator) -> Standing:
    short, longer, height = (float(rng.choice(values)) for values in (SHORT, LONGER_BY, heights))
    return Standing(name, 0.0, 0.0, short, short + longer, height)


def from_low_to_tall(boxes: tuple[Standing, ...], rng: np.random.Generator) -> tuple[Standing, ...]:
    """An order to pack them in: from the low to the tall, with some chance."""
    return tuple(sorted(boxes, key=lambda box: box.height + rng.uniform(0.0, 25.0)))
