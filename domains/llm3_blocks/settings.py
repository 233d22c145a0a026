"""The settings: families of problems, each with the number of its blocks, and the problem of a setting and a seed."""

from __future__ import annotations

from llm3.seeding import generator
from llm3_blocks.cubes import cubes
from llm3_blocks.rebuild import rebuild
from llm3_blocks.solution import Solved

FAMILIES = {"blocks": cubes, "rebuild": rebuild}
SMALL = tuple(f"blocks-{count}" for count in (3, 4, 5, 6))
"""Those that others have results for, too."""
LARGE = ("blocks-8", "blocks-10", "rebuild-6", "rebuild-8", "rebuild-10")
"""Those of which each problem is proven to have a solution."""
SETTINGS = SMALL + LARGE


def generate(setting: str, seed: int) -> Solved:
    """The problem of a setting, such as ``"blocks-4"``, and a seed, with actions that solve it."""
    family, _, count = setting.rpartition("-")
    return FAMILIES[family](int(count), generator("blocks", setting, seed))
