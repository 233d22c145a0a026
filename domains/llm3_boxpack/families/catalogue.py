"""The families by name, and their problems by number of boxes and seed."""

from __future__ import annotations

from collections.abc import Callable, Mapping

import numpy as np

from llm3.errors import LLM3Error, UnknownName, UsageError
from llm3.seeding import generator
from llm3.types import FrozenDict
from llm3_boxpack.families.clutter import clutter
from llm3_boxpack.families.dense import dense
from llm3_boxpack.families.draft import Draft
from llm3_boxpack.families.far import far
from llm3_boxpack.families.hand import Hand
from llm3_boxpack.families.lanes import lanes
from llm3_bullet.robots import panda

Family = Callable[[int, Hand, np.random.Generator], Draft | None]
"""Drafts a problem with so many boxes; None where this did not come to anything."""
FAMILIES: Mapping[str, Family] = FrozenDict({"dense": dense, "far": far, "clutter": clutter, "lanes": lanes})
COUNTS = range(4, 13)
"""How many boxes there may be: with fewer no family is a puzzle, and with more there are no names for them."""
DRAFTS = 3000
"""How many are made for a problem at most; most problems take a few."""


def drafted(family: str, count: int, seed: int) -> Draft:
    """The problem of a family with so many boxes.

    Raises:
        UnknownName: There is no such family.
        UsageError: It cannot be made with so many boxes.
        LLM3Error: No draft came to anything.
    """
    if family not in FAMILIES:
        raise UnknownName("family", family, FAMILIES)
    if count not in COUNTS:
        raise UsageError(f"a family has from {COUNTS[0]} to {COUNTS[-1]} boxes, not {count}.")
    hand, rng = Hand.of(panda().gripper), generator("boxpack", f"{family}-{count}", seed)
    for _ in range(DRAFTS):
        draft = FAMILIES[family](count, hand, rng)
        if draft and draft.is_proven(hand) and draft.is_a_puzzle(hand):
            return draft
    raise LLM3Error(f"none of {DRAFTS} drafts of {family}-{count} with seed {seed} came to a problem with a solution.")
