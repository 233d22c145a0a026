"""The settings: the paper's nine, and families that are made from solutions. A seed draws the problem."""

from __future__ import annotations

from llm3.seeding import generator
from llm3.types import Action
from llm3_boxpack import paper_settings
from llm3_boxpack.families.clutter import clutter
from llm3_boxpack.families.dense import dense
from llm3_boxpack.families.draft import Draft
from llm3_boxpack.families.far import far
from llm3_boxpack.families.hand import Hand
from llm3_boxpack.families.lanes import lanes
from llm3_boxpack.instance import BoxpackInstance
from llm3_bullet.robots.panda import panda

FAMILIES = {"dense": dense, "far": far, "clutter": clutter, "lanes": lanes}
"""What makes the problems of a family, and proves that they can be solved, by its name."""
SIZES = {"dense": (6, 8, 10, 12), "far": (4, 8), "clutter": (4, 8), "lanes": (4, 8)}
"""How many boxes there are."""
DRAFTS = 3000
"""How many are drawn for a problem at most; most problems take a few."""
MADE = tuple(f"{family}-{count}" for family, counts in SIZES.items() for count in counts)
SETTINGS = (*paper_settings.SETTINGS, *MADE)


def generate(setting: str, seed: int) -> BoxpackInstance:
    """The instance of a setting, such as ``"hard-small"`` or ``"dense-8"``, and a seed."""
    return _draft(setting, seed).instance if setting in MADE else paper_settings.generate(setting, seed)


def solution(setting: str, seed: int) -> tuple[Action, ...] | None:
    """Actions that solve the instance of a setting and a seed; None where none are known."""
    return _draft(setting, seed).solution if setting in MADE else None


def _draft(setting: str, seed: int) -> Draft:
    family, count = setting.split("-")
    fingers = panda().fingers
    if fingers is None:
        raise TypeError("the problems are made for fingers")
    hand, rng = Hand.of(fingers), generator("boxpack", setting, seed)
    drafts = (FAMILIES[family](int(count), hand, rng) for _ in range(DRAFTS))
    draft = next((draft for draft in drafts if draft and draft.is_proven(hand)), None)
    if draft is None:
        raise RuntimeError(f"none of {DRAFTS} drafts of {setting}, seed {seed}, is one that the hand can do")
    return draft
