"""All towers taken apart, and all built, in step: for towers so close together that a higher one is in the way."""

from __future__ import annotations

from collections.abc import Mapping

from llm3.types import Sketch
from llm3_blocks.actions import PICK, PLACE, STACK
from llm3_bullet.tabletop.table import TABLE


def in_step(start: Mapping[str, str], goal: Mapping[str, str], heights: Mapping[str, float]) -> tuple[Sketch, ...]:
    """Every block of the goal, and what is above it, to the table, and then to where it belongs.

    The hand has no room beside a tower that is much higher. So the block that is taken next is the highest of all that
    are left, and the one that is put down next the lowest of all that are missing: whatever is taken from a tower, or
    put on one, nothing stands higher then. This works however close together the towers are, if fingers find room.

    Args:
        start: What each block stands on at the start; whatever is no block counts as the table.
        goal: What each block of the goal has to stand on.
        heights: Of all blocks, in metres.
    """
    before, after = tops(start, heights), tops(goal, heights)
    moves: list[Sketch] = []
    for name in sorted(_to_take(start, goal), key=lambda name: (-before[name], name)):
        moves += [Sketch(PICK.name, (name,)), Sketch(PLACE.name, (name,))]
    for name in sorted(goal, key=lambda name: (after[name], name)):
        put = Sketch(PLACE.name, (name,)) if goal[name] == TABLE else Sketch(STACK.name, (name, goal[name]))
        moves += [Sketch(PICK.name, (name,)), put]
    return tuple(moves)


def tops(below: Mapping[str, str], heights: Mapping[str, float]) -> dict[str, float]:
    """How high the top of each block comes, in metres.

    Args:
        below: What each stands on; what is not told is on the table.
        heights: Of all blocks, in metres.
    """

    def top(name: str) -> float:
        return round(top(below.get(name, TABLE)) + heights[name], 6) if name in heights else 0.0

    return {name: top(name) for name in below}


def _to_take(start: Mapping[str, str], goal: Mapping[str, str]) -> set[str]:
    """The blocks of the goal, and what is above them, or above what they shall stand on."""
    concerned, found = {*goal, *goal.values()}, set(goal)
    for name in start:
        at = start[name]
        while at in start:
            if at in concerned:
                found.add(name)
            at = start[at]
    return found
