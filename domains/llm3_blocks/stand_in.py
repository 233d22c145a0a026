"""A rule-based stand-in for a language model: it takes apart what is in the way, and builds from the bottom up.

It reads what a prompt tells and nothing else. It does not know how far the arm reaches or how much room the hand
really needs: it starts with a guess, and corrects its plans by the kinds of the failures.
"""

from __future__ import annotations

import json
import re
from collections.abc import Sequence
from math import hypot, inf

import numpy as np

from llm3.types import Action, Context, Entity, FailureKind, Sketch
from llm3_blocks.actions import PLACE
from llm3_blocks.in_step import in_step
from llm3_blocks.lessons import Lesson, crowded, lessons_of
from llm3_blocks.places import Point, Spot, Wishes, free_place
from llm3_blocks.sequence import sequence

FIRST_GAP, GAP_STEP, LARGEST_GAP = 0.02, 0.03, 0.14
"""Free space around blocks in metres: the first guess, what a collision adds to it, and the most it asks for."""
REACH_STEP = 0.02
"""After a place was out of reach, the next ones are this much closer to the arm, in metres."""
PATIENCE = 3
"""After so many failures in a row behind the same actions, all places are chosen anew."""
STUBBORN = 2
"""After so many collisions at towers, all are taken apart, and built, in step."""
ELSEWHERE = "elsewhere"
"""Where a block stands that has to be moved, although it belongs on the table."""
FACT = re.compile(r"\bon\((\w+), (\w+)\)")


def reply(context: Context, rng: np.random.Generator) -> str:
    """A reply in the format that the prompt asks for."""
    lessons = lessons_of(context)
    blocks = {entity.name: entity for entity in context.state if entity.name in context.objects}
    below = {name: support for name, support in FACT.findall(context.task) if name in blocks}
    kept, reasoning = _kept(lessons)
    lowest = {name: _spot(entity).center for name, entity in blocks.items() if _support(entity) not in blocks}
    restless = crowded(lessons, below, lowest) | (set(kept) & set(lowest))
    moves = context.skeleton or _moves(blocks, below, restless, lessons)
    plan = _with_places(moves, blocks, kept, _wishes(lessons), rng)
    return json.dumps({"Reasoning": reasoning, "Full Plan": [str(action) for action in plan]})


def _moves(
    blocks: dict[str, Entity], below: dict[str, str], restless: set[str], lessons: Sequence[Lesson]
) -> Sequence[Sketch]:
    """The shortest way or, where towers are in one another's way again and again, all in step."""
    start = {name: _support(entity) for name, entity in blocks.items()}
    moved = {name: ELSEWHERE for name in restless if start.get(name) not in blocks}
    usual = sequence({**start, **moved}, below)
    together = in_step(start, below, {name: _size(entity)[2] for name, entity in blocks.items()})
    stuck = sum(lesson.crowded for lesson in lessons) >= STUBBORN
    last = lessons[-1] if lessons else None
    going = last and last.worked and last.began_with(together) and not last.began_with(usual)
    return together if stuck or going else usual


def _with_places(
    moves: Sequence[Sketch],
    blocks: dict[str, Entity],
    kept: dict[str, Action],
    wishes: Wishes,
    rng: np.random.Generator,
) -> list[Action]:
    """The moves with places for what is put on the table: those that are kept, and new ones."""
    standing = {name: _spot(entity) for name, entity in blocks.items()}
    taken = [*standing.values(), *(Spot(_point(a), standing[n].radius) for n, a in kept.items() if n in standing)]
    plan: list[Action] = []
    for move in moves:
        name = move.objects[0]
        if move.name != PLACE.name:
            plan.append(Action(move.name, move.objects))
        elif name in kept:
            plan.append(kept[name])
        else:
            spot = free_place(standing[name].radius, taken, wishes, rng)
            taken.append(spot)
            plan.append(Action(PLACE.name, (name,), {"x": spot.center[0], "y": spot.center[1], "theta": 0.0}))
    return plan


def _kept(lessons: Sequence[Lesson]) -> tuple[dict[str, Action], str]:
    """Which places of the last plan to keep, and why."""
    if not lessons:
        return {}, "There is no earlier plan. I take apart what is in the way, and build from the bottom up."
    last = lessons[-1]
    if last.failed is None or last.kind is FailureKind.PRECONDITION:
        return {}, "The last plan did not lead where I thought. I choose all places anew."
    why = f"The last plan failed at {last.failed}"
    why += ", because it is out of reach." if last.kind is FailureKind.UNREACHABLE else ", because of what is around."
    recent = lessons[-PATIENCE:]
    if len(recent) == PATIENCE and all(lesson.worked == last.worked for lesson in recent):
        return {}, f"{why} This does not change, so I choose all places anew."
    if last.failed.name != PLACE.name:
        return {}, f"{why} I choose other places, with more room."
    return last.places, f"{why} I keep what worked before it and choose another place."


def _wishes(lessons: Sequence[Lesson]) -> Wishes:
    collisions = sum(lesson.touching for lesson in lessons)
    failed = [(lesson.failed_place, lesson.kind) for lesson in lessons if lesson.failed_place]
    far = (hypot(*place) for place, kind in failed if place and kind is FailureKind.UNREACHABLE)
    return Wishes(
        gap=min(FIRST_GAP + GAP_STEP * collisions, LARGEST_GAP),
        reach=min(far, default=inf) - REACH_STEP,
        failed=tuple(place for place, _ in failed if place),
    )


def _support(block: Entity) -> str:
    return str(block.properties.get("stands on", ""))


def _spot(block: Entity) -> Spot:
    position, size = block.properties["position"], _size(block)
    if not isinstance(position, tuple):
        raise TypeError(f"{block.name} has no place to start from")
    return Spot((position[0], position[1]), hypot(size[0], size[1]) / 2)


def _size(block: Entity) -> tuple[float, ...]:
    size = block.properties["size"]
    if not isinstance(size, tuple):
        raise TypeError(f"{block.name} has no size")
    return size


def _point(action: Action) -> Point:
    return action.params["x"], action.params["y"]
