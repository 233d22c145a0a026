"""What an action changed, taken apart."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass, replace
from math import acos, dist

from llm3.types import Held, Pose, State

MOVED, TURNED = 0.01, 0.3
"""How far an object has moved, or turned, of which the model must hear, in metres and radians."""


@dataclass(frozen=True)
class Change:
    """One part of what an action changed, alone."""

    part: str
    """What it is, such as ``"where 'cup' is"``."""
    states: tuple[State, State]
    """Two states that differ in this part alone; no action need lead from one to the other."""
    cause: str
    """What is wrong where nobody can tell the two states apart."""
    object: str = ""
    """Whose pose it is; empty for what is no pose."""


def changes(start: State, before: State, after: State) -> Iterator[Change]:
    """Every change of an object's place, of how it is turned, of what is held and of a fact; each alone."""
    for name, pose in after.poses.items():
        beside, old = (before, before) if name in before.poses else (after, start)  # what was held has no place before
        if name in old.poses:
            yield from _moves(name, beside, old.poses[name], pose)
    if _name(before.held) != _name(after.held):
        names = {_name(before.held), _name(after.held)}
        poses = {name: pose for name, pose in before.poses.items() if name not in names}
        poses |= {name: pose for name, pose in after.poses.items() if name in names}
        gripped = replace(before, poses=poses, held=after.held)
        taken, put = _name(after.held), _name(before.held)
        part = f"whether {taken!r} is held" if taken else f"whether {put!r} is still held"
        yield Change(part, (before, gripped), "describe tells what is held as state.held has it.")
    for name in sorted({*before.facts, *after.facts}):
        if before.facts.get(name) != after.facts.get(name):
            facts = {key: fact for key, fact in before.facts.items() if key != name}
            facts |= {name: after.facts[name]} if name in after.facts else {}
            cause = "describe tells each fact as state.facts has it."
            yield Change(f"the fact {name!r}", (before, replace(before, facts=facts)), cause)


def _moves(name: str, beside: State, old: Pose, new: Pose) -> Iterator[Change]:
    if dist(old.position, new.position) > MOVED:
        moved = Pose(new.position, old.orientation)
        states = _with(beside, name, old), _with(beside, name, moved)
        yield Change(f"where {name!r} is", states, "describe tells where each object is as state.poses has it.", name)
    cosine = abs(sum(a * b for a, b in zip(old.orientation, new.orientation, strict=True)))
    if 2 * acos(min(1.0, cosine)) > TURNED:
        turned = Pose(old.position, new.orientation)
        states = _with(beside, name, old), _with(beside, name, turned)
        cause = "describe tells how each object is turned as state.poses has it, or apply leaves that alone."
        yield Change(f"how {name!r} is turned", states, cause, name)


def _with(state: State, name: str, pose: Pose) -> State:
    return replace(state, poses={**state.poses, name: pose})


def _name(held: Held | None) -> str:
    return held.object if held else ""
