"""Problems with what solves them: a solution that works wherever there is room."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

from llm3.types import Action, Sketch
from llm3_blocks.actions import PLACE
from llm3_blocks.in_step import in_step
from llm3_blocks.instance import BlocksInstance


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


def steps(instance: BlocksInstance) -> tuple[Sketch, ...]:
    """What solves it wherever there is room, without the places."""
    heights = {name: size[2] for name, size in instance.sizes.items()}
    return in_step(instance.start, {on.block: on.below for on in instance.goal}, heights)


def solution(instance: BlocksInstance, aside: Sequence[Spot], bases: Sequence[Spot] = ()) -> tuple[Action, ...]:
    """The actions of `steps`.

    Args:
        instance: The problem.
        aside: Where blocks can be put aside, one for each block of the goal.
        bases: Where towers can be built, one for each that belongs on the table.
    """
    count = len(instance.goal)
    spots = iter((*aside[:count], *bases))
    return tuple(
        Action(move.name, move.objects, _at(next(spots)) if move.name == PLACE.name else {}) for move in steps(instance)
    )


def _at(spot: Spot) -> dict[str, float]:
    return {"x": spot.x, "y": spot.y, "theta": 0.0}
