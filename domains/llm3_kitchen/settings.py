"""The settings: how much is to be served, in which kind of kitchen. What stands where is drawn from a seed."""

from __future__ import annotations

from collections.abc import Callable
from functools import partial

import numpy as np

from llm3.seeding import generator
from llm3_kitchen.cramped import cramped
from llm3_kitchen.feasts import feast
from llm3_kitchen.known import Known
from llm3_kitchen.meals import meal

MEALS = {f"kitchen-{count}": count for count in (3, 4, 5, 6)}
FEASTS = {f"kitchen-{count}": count for count in (8, 10)}
CRAMPED = {f"cramped-{count}": count for count in (4, 6, 8)}
"""How much food there is, by the setting's name."""
SETTINGS: dict[str, Callable[[np.random.Generator], Known]] = {
    name: partial(family, count)
    for family, counts in ((meal, MEALS), (feast, FEASTS), (cramped, CRAMPED))
    for name, count in counts.items()
}
"""What makes the problem of a setting."""


def generate(setting: str, seed: int) -> Known:
    """The problem of a setting, such as ``"kitchen-4"``, and a seed, and what is known to solve it."""
    return SETTINGS[setting](generator("kitchen", setting, seed))
