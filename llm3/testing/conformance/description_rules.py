"""Rules for whether a model hears of what actions change."""

from __future__ import annotations

from collections.abc import Iterator
from contextlib import suppress
from dataclasses import dataclass, replace
from math import dist

from llm3.interfaces import Env
from llm3.prompts import value
from llm3.testing.conformance.inspection import Fault
from llm3.testing.conformance.world import Trial, World
from llm3.types import Held, State

MOVED = 0.01
"""How far an object has moved of which the model must hear, in metres."""


@dataclass(frozen=True)
class Change:
    """One part of what an action changed, alone."""

    part: str
    """What it is, such as ``"where 'cup' is"``."""
    states: tuple[State, State]
    """Two states that differ in this part alone; no action need lead from one to the other."""
    cause: str
    """What is wrong where nobody can tell the two states apart."""


def described(env: Env, state: State) -> list[str]:
    """A line for each thing that the description tells of."""
    return [
        f"{e.name}: " + "; ".join(f"{name} {value(p)}" for name, p in e.properties.items()) for e in env.describe(state)
    ]


def the_description_follows_the_state(world: World) -> Iterator[Fault]:
    """Each part of the state that actions change, alone, changes the description in some state."""
    changing = [(trial, after) for trial in world.applied if (after := _after(trial)) != trial.state]
    if changing and not any(_told_apart(world.env, trial.state, after) for trial, after in changing):
        yield Fault(
            f"the description is the same before and after {changing[0][0]}, which changed the state.",
            "describe must look at the state that it is given, and tell what actions change in it.",
        )
        return
    silent: dict[str, tuple[Trial, Change]] = {}
    told: set[str] = set()
    for trial, after in changing:
        for change in _changes(world.start, trial.state, after):
            if change.part in told:
                continue
            with suppress(Exception):  # a state that no action leads to may have no description
                if _told_apart(world.env, *change.states):
                    told.add(change.part)
                else:
                    silent.setdefault(change.part, (trial, change))
    for part, (trial, change) in silent.items():
        if part not in told:
            yield Fault(
                f"{trial} changes {part}, and the description with that alone changed is the same.", change.cause
            )


def _after(trial: Trial) -> State:
    return trial.transition.state if trial.transition else trial.state


def _told_apart(env: Env, one: State, other: State) -> bool:
    return described(env, one) != described(env, other)


def _changes(start: State, before: State, after: State) -> Iterator[Change]:
    """Every change of an object's place, of what is held and of a fact; each alone."""
    for name, pose in after.poses.items():
        beside, old = (before, before) if name in before.poses else (after, start)  # what was held has no place before
        if name in old.poses and dist(old.poses[name].position, pose.position) > MOVED:
            one, other = (replace(beside, poses={**beside.poses, name: p}) for p in (old.poses[name], pose))
            cause = "describe tells where each object is as state.poses has it."
            yield Change(f"where {name!r} is", (one, other), cause)
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


def _name(held: Held | None) -> str:
    return held.object if held else ""


RULES = (the_description_follows_the_state,)
