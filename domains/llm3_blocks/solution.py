"""A solution that works wherever there is room: everything is taken apart, then all towers are built in step."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass

from llm3.types import Action, Sketch
from llm3_blocks.actions import PICK, PLACE, STACK
from llm3_blocks.instance import BlocksInstance
from llm3_bullet.tabletop.table import TABLE


@dataclass(frozen=True)
class Spot:
    """A place on the table with room for a block and the hand above it, in metres; the block lies along the axes."""

    x: float
    y: float


@dataclass(frozen=True)
class Solved:
    """A problem, and actions that solve it."""

    instance: BlocksInstance
    witness: tuple[Action, ...]


def in_step(instance: BlocksInstance) -> tuple[Sketch, ...]:
    """Every block of the goal, and what is above it, to the table, and then to where it belongs.

    The hand has no room beside a tower that is much higher. So the block that is taken next is the highest of all that
    are left, and the one that is put down next the lowest of all that are missing: whatever is taken from a tower, or
    put on one, nothing stands higher then. This works however close together the towers are, if fingers find room.

    Args:
        instance: The problem.
    """
    below = {on.block: on.below for on in instance.goal}
    before, after = tops(instance.start, instance), tops(below, instance)
    moves: list[Sketch] = []
    for name in sorted(_to_take(instance), key=lambda name: (-before[name], name)):
        moves += [Sketch(PICK.name, (name,)), Sketch(PLACE.name, (name,))]
    for name in sorted(below, key=lambda name: (after[name], name)):
        to_table = below[name] == TABLE
        put = Sketch(PLACE.name, (name,)) if to_table else Sketch(STACK.name, (name, below[name]))
        moves += [Sketch(PICK.name, (name,)), put]
    return tuple(moves)


def solution(instance: BlocksInstance, aside: Sequence[Spot], bases: Sequence[Spot] = ()) -> tuple[Action, ...]:
    """The actions of `in_step`.

    Args:
        instance: The problem.
        aside: Where blocks can be put aside, one for each block of the goal.
        bases: Where towers can be built, one for each that belongs on the table.
    """
    count = len(instance.goal)
    spots = iter((*aside[:count], *bases))
    return tuple(
        Action(move.name, move.objects, _at(next(spots)) if move.name == PLACE.name else {})
        for move in in_step(instance)
    )


def tops(below: Mapping[str, str], instance: BlocksInstance) -> dict[str, float]:
    """How high the top of each block comes, in metres, given what each stands on; what is not told is on the table."""
    sizes = instance.sizes

    def top(name: str) -> float:
        return 0.0 if name == TABLE else round(top(below.get(name, TABLE)) + sizes[name][2], 6)

    return {name: top(name) for name in below}


def _to_take(instance: BlocksInstance) -> set[str]:
    """The blocks of the goal, and what is above them, or above what they shall stand on."""
    concerned = {name for on in instance.goal for name in (on.block, on.below)}
    above = {
        name
        for tower in instance.towers
        for index, name in enumerate(tower.blocks)
        if not concerned.isdisjoint(tower.blocks[:index])
    }
    return above | {on.block for on in instance.goal}


def _at(spot: Spot) -> dict[str, float]:
    return {"x": spot.x, "y": spot.y, "theta": 0.0}
