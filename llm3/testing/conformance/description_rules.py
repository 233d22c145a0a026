"""Rules for whether a model hears of what actions change."""

from __future__ import annotations

import re
from collections.abc import Iterator
from contextlib import suppress
from dataclasses import dataclass, replace
from itertools import pairwise

import numpy as np

from llm3.interfaces import Env
from llm3.prompts import value
from llm3.testing.conformance.changes import Change, changes
from llm3.testing.conformance.inspection import Fault
from llm3.testing.conformance.world import Trial, World, spread
from llm3.types import Pose, State

STEP, STEPS, SHOWN = 0.02, 5, 3
"""How an object is shifted, in metres, how often, and how often that must show at least."""
OBJECTS, STATES = 8, 4
"""How many objects are shifted, and in how many states."""
_NUMBER = re.compile(r"-?\d+\.\d+")


def described(env: Env, state: State) -> list[str]:
    """A line for each thing that the description tells of."""
    return [
        f"{e.name}: " + "; ".join(f"{name} {value(p)}" for name, p in e.properties.items()) for e in env.describe(state)
    ]


@dataclass
class _Heard:
    """What the description tells of one part of the state that actions change."""

    trial: Trial
    change: Change
    told: bool = False
    measured: bool = False
    """Whether it tells a number of it."""
    others: tuple[str, ...] = ()
    """The lines that change, where they are of other objects."""


def the_description_follows_the_state(world: World) -> Iterator[Fault]:
    """Each part of the state that actions change, alone, changes what the description tells of it in some state."""
    changing = [(trial, after) for trial in world.applied if (after := _after(trial)) != trial.state]
    if changing and not any(_lines(world.env, trial.state, after) for trial, after in changing):
        yield Fault(
            f"the description is the same before and after {changing[0][0]}, which changed the state.",
            "describe must look at the state that it is given, and tell what actions change in it.",
        )
        return
    heard: dict[str, _Heard] = {}
    for trial, after in changing:
        for change in changes(world.start, trial.state, after):
            now = heard.setdefault(change.part, _Heard(trial, change))
            with suppress(Exception):  # a state that no action leads to may have no description
                _listen(world, change, now)
    moves = [now for now in heard.values() if now.change.object]
    measured = any(now.measured for now in moves)
    for now in heard.values():
        if now.told:
            continue
        if now.others:
            yield Fault(
                f"{now.trial} changes {now.change.part}, and what that alone changes in the description is told of "
                f"something else: {now.others[0]}.",
                "describe tells of each object under its own name, as state.poses has it.",
            )
        elif measured or not now.change.object or not any(other.told for other in moves):  # west may stay west
            yield Fault(
                f"{now.trial} changes {now.change.part}, and the description with that alone changed is the same.",
                now.change.cause,
            )


def _listen(world: World, change: Change, heard: _Heard) -> None:
    lines = _lines(world.env, *change.states)
    name = change.object
    others = {*world.env.objects, *change.states[0].poses} - {name}
    if name and lines and all(line.partition(":")[0] in others and not _names(line, name) for line in lines):
        heard.others = heard.others or tuple(sorted(lines))
        return
    heard.told |= bool(lines)
    heard.measured |= bool(name) and _measured(lines)


def a_small_move_is_told(world: World) -> Iterator[Fault]:
    """Where a number is told of where an object is, it tells moves of 2 cm."""
    for name in spread(sorted(world.start.poses), OBJECTS):
        shown = [
            _shown(world.env, state, name, axis)
            for state in spread([state for state in world.states if name in state.poses], STATES)
            for axis in (0, 1)
        ]
        counts = [count for count in shown if count is not None]
        if counts and max(counts) < SHOWN:
            yield Fault(
                f"{STEPS} moves of {name!r} by {STEP:g} m each, one after the other, show {max(counts)} times in the "
                "description.",
                "describe rounds where an object is too coarsely for a model that has to aim: write centimetres, or "
                "millimetres.",
            )


def _shown(env: Env, state: State, name: str, axis: int) -> int | None:
    """How often a number changes while an object is shifted; None where none does, or there is no description."""
    place = np.array(state.poses[name].position)
    steps = [place + np.eye(3)[axis] * STEP * step for step in range(STEPS + 1)]
    poses = [Pose(tuple(map(float, at)), state.poses[name].orientation) for at in steps]
    with suppress(Exception):
        told = [tuple(_NUMBER.findall("\n".join(_of(env, state, name, pose)))) for pose in poses]
        return sum(a != b for a, b in pairwise(told)) or None if len(set(map(len, told))) == 1 else None
    return None


def _of(env: Env, state: State, name: str, pose: Pose) -> list[str]:
    """The lines on one object, if it stood elsewhere."""
    return [line for line in described(env, replace(state, poses={**state.poses, name: pose})) if _names(line, name)]


def _names(line: str, name: str) -> bool:
    return re.search(rf"(?<!\w){re.escape(name)}(?!\w)", line) is not None


def _after(trial: Trial) -> State:
    return trial.transition.state if trial.transition else trial.state


def _lines(env: Env, one: State, other: State) -> set[str]:
    """The lines in which two descriptions differ."""
    return set(described(env, one)) ^ set(described(env, other))


def _measured(lines: set[str]) -> bool:
    return any(_NUMBER.search(line) for line in lines)


RULES = (the_description_follows_the_state, a_small_move_is_told)
