"""A rule-based stand-in for a language model: rules of thumb for moving things around, and for learning from feedback.

It reads what a prompt tells and nothing else. It does not know how near the robot may come to things or how wide a gap
must be: it keeps what worked, does otherwise what failed, and moves what nobody asked for when there is no way.
"""

from __future__ import annotations

import json
from collections.abc import Sequence
from itertools import takewhile
from math import atan2, hypot, pi

import numpy as np

from llm3.types import Action, Context, FailureKind, Sketch
from llm3_tabletop2d.actions import LARGEST_CARRIED, PICK, PLACE, PUSH
from llm3_tabletop2d.lessons import Lesson, lessons_of
from llm3_tabletop2d.spots import JITTER, aside, spot_in
from llm3_tabletop2d.table import Table, Thing, table_of

PATIENCE = 3
"""After so many failures in a row after the same actions, the last of these is given up too."""
ENOUGH = 5
"""After so many failures in a row with the same object, everything is done anew."""
NO_WAY = (FailureKind.UNREACHABLE, FailureKind.NO_PATH)
QUARTER = pi / 2


def reply(context: Context, rng: np.random.Generator) -> str:
    """A reply in the format that the prompt asks for."""
    lessons = lessons_of(context)
    kept, reasoning = _kept(lessons)
    if context.skeleton:
        kept = _as_given(kept, context.skeleton)
    table = table_of(context.state)
    for action in kept:
        table = table.after(action)
    writer = _Writer(table, kept, lessons, rng)
    plan = writer.filled(context, kept) if context.skeleton else (*kept, *writer.rest())
    return json.dumps({"Reasoning": reasoning, "Full Plan": [str(action) for action in plan]})


def _as_given(actions: tuple[Action, ...], skeleton: Sequence[Sketch]) -> tuple[Action, ...]:
    """The first of them that are those of a given sequence."""
    alike = ((a.name, a.objects) == (s.name, s.objects) for a, s in zip(actions, skeleton, strict=False))
    return actions[: sum(1 for _ in takewhile(bool, alike))]


def _kept(lessons: Sequence[Lesson]) -> tuple[tuple[Action, ...], str]:
    """Which actions of the last plan to keep, and why."""
    if not lessons:
        return (), "There is no earlier plan. I bring each object where it belongs, from its far side."
    last = lessons[-1]
    if last.failed is None:
        return (), "The last plan worked, but did not reach the goal. I choose everything anew."
    worked, why = last.worked, f"The last plan failed at {last.failed}."
    if last.failed.name == PLACE and last.kind in NO_WAY and worked:
        return worked[:-1], f"{why} There is no way, so I take the object from another side."
    objects = {lesson.failed.objects for lesson in lessons[-ENOUGH:] if lesson.failed}
    if len(lessons) >= ENOUGH and len(objects) == 1:
        return (), f"{why} It has failed so often that I choose everything anew."
    alike = [lesson for lesson in lessons[-PATIENCE:] if lesson.worked == worked]
    if len(alike) == PATIENCE and worked:
        fewer = worked[:-1] if worked[-1].name == PICK else worked[: -2 if worked[-1].name == PLACE else -1]
        return fewer, f"{why} Other numbers failed too, so I also do the action before it otherwise."
    return worked, f"{why} I keep what worked before it, and do the rest otherwise."


class _Writer:
    """Writes the rest of a plan, from where things are."""

    def __init__(
        self, table: Table, kept: tuple[Action, ...], lessons: Sequence[Lesson], rng: np.random.Generator
    ) -> None:
        self._table, self._lessons, self._rng = table, lessons, rng
        self._failed = [(_moved(lesson.worked), f) for lesson in lessons if (f := lesson.failed)]
        self._no_way = [f for lesson in lessons if (f := lesson.failed) and lesson.kind in NO_WAY]
        self._done = _moved(kept)

    def rest(self) -> tuple[Action, ...]:
        """What is still to be done, without a given sequence."""
        plan: list[Action] = []
        if self._table.held:
            plan += self._put(self._table.things[self._table.held])
        if self._no_way:
            for name in self._in_the_way():
                plan += self._bring(self._table.things[name], away=True)
        waiting = [thing for thing in self._table.things.values() if not self._table.is_home(thing.name)]
        waiting.sort(key=self._rank)
        while waiting:
            open_ = [thing for thing in waiting if not self._table.guests(thing)]
            if open_:
                thing = open_[0]
                waiting.remove(thing)
                plan += self._bring(thing)
            else:  # each belongs where another one is: the first one makes room
                plan += self._bring(waiting[0], away=True)
                if len(plan) > 100:
                    break
        return tuple(plan)

    def filled(self, context: Context, kept: tuple[Action, ...]) -> tuple[Action, ...]:
        """The given sequence, as far as it goes with what is kept."""
        plan: list[Action] = list(kept)
        for index in range(len(kept), len(context.skeleton)):
            sketch = context.skeleton[index]
            thing = self._table.things[sketch.objects[0]]
            again = any(s.objects == sketch.objects and s.name != PICK for s in context.skeleton[index + 1 :])
            leave = sketch.name == PUSH and again
            if sketch.name == PICK:
                action = self._picked(thing, self._target(thing, leave))
            else:
                x, y = self._target(thing, leave)
                action = Action(sketch.name, (thing.name,), {"x": x, "y": y})
            plan.append(self._moved(action))
        return tuple(plan)

    def _rank(self, thing: Thing) -> tuple[int, float]:
        """Large objects come before small ones, and what there was no way for after all others."""
        return sum(f.objects == (thing.name,) for f in self._no_way), -thing.size[0] * thing.size[1]

    def _in_the_way(self) -> list[str]:
        """What nobody asked for and has not been moved: the nearest to the robot first, one for each two failures."""
        moved = {action.objects[0] for action in self._lessons[-1].worked} if self._lessons else set()
        loose = [t for t in self._table.things.values() if t.region is None and t.name not in moved]
        loose.sort(key=lambda t: hypot(t.x - self._table.robot[0], t.y - self._table.robot[1]))
        return [thing.name for thing in loose[: (len(self._no_way) + 1) // 2]]

    def _bring(self, thing: Thing, away: bool = False) -> list[Action]:
        target = self._target(thing, away)
        if max(thing.size) > LARGEST_CARRIED:
            return [self._moved(Action(PUSH, (thing.name,), {"x": target[0], "y": target[1]}))]
        goes = (2 * thing.x - self._table.robot[0], 2 * thing.y - self._table.robot[1]) if away else target
        picked = self._moved(self._picked(thing, goes))
        return [picked, self._moved(Action(PLACE, (thing.name,), {"x": target[0], "y": target[1]}))]

    def _put(self, thing: Thing) -> list[Action]:
        x, y = self._target(thing, thing.region is None)
        return [self._moved(Action(PLACE, (thing.name,), {"x": x, "y": y}))]

    def _moved(self, action: Action) -> Action:
        self._table = self._table.after(action)
        self._done |= _moved((action,))
        return action

    def _target(self, thing: Thing, away: bool) -> tuple[float, float]:
        tried = tuple(
            (f.params["x"], f.params["y"]) for _, f in self._failed if f.objects == (thing.name,) and "x" in f.params
        )
        if away or thing.region is None:
            return aside(self._table, thing, tried, self._rng)
        return spot_in(self._table, thing, tried, JITTER * (1 + len(self._lessons)), self._rng)

    def _picked(self, thing: Thing, target: tuple[float, float]) -> Action:
        """From the side away from where it goes, along x or along y; where that has failed, from another side."""
        away = atan2(thing.y - target[1], thing.x - target[0])
        straight = round(away / QUARTER) * QUARTER
        tries = sum(done == self._done and f.objects == (thing.name,) for done, f in self._failed)
        turn = (0.0, QUARTER, -QUARTER, 2 * QUARTER)[tries % 4] if tries < 8 else float(self._rng.uniform(-pi, pi))
        jitter = 0.0 if tries < 4 else float(self._rng.uniform(-0.3, 0.3))
        angle = (straight + turn + jitter + pi) % (2 * pi) - pi
        return Action(PICK, (thing.name,), {"angle": round(max(-3.14, min(3.14, angle)), 3)})


def _moved(actions: Sequence[Action]) -> frozenset[str]:
    """The objects that these actions put somewhere else."""
    return frozenset(action.objects[0] for action in actions if action.name != PICK)
