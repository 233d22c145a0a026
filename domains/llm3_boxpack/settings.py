"""The settings: the paper's nine, and families that are made from solutions. A seed draws the problem."""

from __future__ import annotations

from typing import TYPE_CHECKING

from llm3_boxpack import paper_settings

if TYPE_CHECKING:  # what makes the families' problems reckons with the hand, which is not cheap to import
    from llm3.types import Action
    from llm3_boxpack.families import Draft
    from llm3_boxpack.instance import BoxpackInstance

SIZES = {"dense": (6, 8, 10, 12), "far": (4, 8), "clutter": (4, 8), "lanes": (4, 8)}
"""The families, and how many boxes there are."""
MADE = tuple(f"{family}-{count}" for family, counts in SIZES.items() for count in counts)
SETTINGS = (*paper_settings.SETTINGS, *MADE)


def generate(setting: str, seed: int) -> BoxpackInstance:
    """The instance of a setting, such as ``"hard-small"`` or ``"dense-8"``, and a seed."""
    return _draft(setting, seed).instance if setting in MADE else paper_settings.generate(setting, seed)


def solution(setting: str, seed: int) -> tuple[Action, ...] | None:
    """Actions that solve the instance of a setting and a seed; None where none are known."""
    return _draft(setting, seed).solution if setting in MADE else None


def _draft(setting: str, seed: int) -> Draft:
    from llm3_boxpack.families import drafted

    family, _, count = setting.partition("-")
    return drafted(family, int(count), seed)
