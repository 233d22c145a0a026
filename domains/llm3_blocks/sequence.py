"""Which block goes where, one after another: towers as symbols, without geometry."""

from __future__ import annotations

from collections.abc import Mapping

from llm3.types import Sketch
from llm3_blocks.actions import PICK, PLACE, STACK
from llm3_bullet.tabletop.table import TABLE


def sequence(start: Mapping[str, str], goal: Mapping[str, str]) -> tuple[Sketch, ...]:
    """Actions that lead from the start to the goal.

    A block goes where it belongs as soon as it can, and to the table if it is in the way. What stands right, on
    what stands right, is left alone.

    Args:
        start: What each block stands on; whatever is no block counts as a place that has to be left.
        goal: What each block has to stand on; a block that is missing may be on the table, or where it is if it is in
            nobody's way.
    """
    below = dict(start)
    moves: list[Sketch] = []
    while True:
        move = _next(below, goal)
        if move is None:
            return tuple(moves)
        block, target = move
        moves.append(Sketch(PICK.name, (block,)))
        moves.append(Sketch(PLACE.name, (block,)) if target == TABLE else Sketch(STACK.name, (block, target)))
        below[block] = target


def _next(below: Mapping[str, str], goal: Mapping[str, str]) -> tuple[str, str] | None:
    """The next block and what it goes on; None if all stand right."""
    clear = [block for block in below if block not in below.values() and not _is_right(block, below, goal)]
    for block in clear:
        target = goal.get(block, TABLE)
        if target == TABLE or (target not in below.values() and _is_right(target, below, goal)):
            return block, target
    return next(((block, TABLE) for block in clear if below[block] != TABLE), None)


def _is_right(block: str, below: Mapping[str, str], goal: Mapping[str, str]) -> bool:
    """Whether a block can stay where it is."""
    support = below[block]
    wanted = goal.get(block)
    if wanted is None:
        fits = support == TABLE or (support in below and support not in goal.values())
    else:
        fits = support == wanted
    return fits and (support == TABLE or _is_right(support, below, goal))
