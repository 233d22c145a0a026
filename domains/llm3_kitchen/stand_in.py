"""A rule-based stand-in for a language model: rules of thumb for kitchen work, and for learning from feedback.

It reads what a prompt tells and nothing else. It does not know what is in the way of the hand: it tries, and moves what
the feedback names.
"""

from __future__ import annotations

import json
from collections.abc import Sequence
from math import hypot

import numpy as np

from llm3.types import Action, Context, FailureKind
from llm3_kitchen.actions import HEAT, PICK, PLACE, WASH
from llm3_kitchen.lessons import Lesson, is_stuck, lessons_of
from llm3_kitchen.picture import Picture, picture_of
from llm3_kitchen.spots import choose_spot

FIRST_GAP, GAP_STEP = 0.035, 0.03
"""Room between things in metres: the first guess, and what each collision of a thing adds to it."""


def reply(context: Context, rng: np.random.Generator) -> str:
    """A reply in the format that the prompt asks for."""
    start = picture_of(context)
    lessons = lessons_of(context, start.things)
    kept, first, reasoning = _kept(start, lessons)
    work = _Work(start, lessons, rng)
    for action in kept:
        work.add(action)
    work.finish_move()
    foods = [name for name, thing in start.things.items() if thing.goal]
    for name in dict.fromkeys((*first, *rng.permutation(foods).tolist())):
        work.see_to(name)
    return json.dumps({"Reasoning": reasoning, "Full Plan": [str(action) for action in work.plan]})


def _kept(start: Picture, lessons: Sequence[Lesson]) -> tuple[tuple[Action, ...], tuple[str, ...], str]:
    """How the next plan begins, what it sees to first, and why."""
    if not lessons:
        return (), (), "There is no earlier plan. I prepare one food after the other."
    last = lessons[-1]
    if last.failed is None:
        return (), (), "The last plan worked, but did not reach the goal. I plan anew."
    why = f"The last plan failed at {last.failed}."
    name = last.failed.objects[0]
    if is_stuck(lessons):
        return last.beginning, (), f"{why} I tried other ways to go on, so I also change the last move that worked."
    if last.failed.name == PLACE.name:
        return last.worked, (), f"{why} I keep what worked before it and choose another spot for {name}."
    if last.failed.name != PICK.name:
        return last.beginning, (), f"{why} I change the move before it."
    picture = start
    for action in last.worked:
        picture = picture.after(action)
    named = [other for other in last.named if other in picture.spots and other != name]
    if named:
        return last.worked, (named[0], name), f"{why} {named[0]} is in the way, so I see to it before."
    if last.bad_spot and last.kind is not None:
        return last.beginning, (), f"{why} I choose another spot for {name} where I put it down."
    guess = _nearest(picture, name)
    return last.worked, (guess, name) if guess else (), f"{why} I see to what stands nearest to {name} before."


def _nearest(picture: Picture, name: str) -> str | None:
    """What stands nearest to something, and is not served."""
    spot = picture.spots.get(name)
    if spot is None:
        return None
    others = [other for other in picture.spots if other != name and not picture.stands_in(other, "serving")]
    return min(others, key=lambda o: hypot(picture.spots[o].x - spot.x, picture.spots[o].y - spot.y), default=None)


class _Work:
    """A plan that grows, and the kitchen as it would leave it."""

    def __init__(self, start: Picture, lessons: Sequence[Lesson], rng: np.random.Generator) -> None:
        self.plan: list[Action] = []
        self._picture, self._lessons, self._rng = start, lessons, rng

    def add(self, action: Action) -> None:
        """Do something next."""
        self.plan.append(action)
        self._picture = self._picture.after(action)

    def finish_move(self) -> None:
        """Put down what is in the hand, and go on with it."""
        name = self._picture.held
        if name:
            self.see_to(name)

    def see_to(self, name: str) -> None:
        """Prepare and serve a food; take clutter out of the way."""
        goal = self._picture.things[name].goal
        if not goal:
            self._bring(name, "worktop", "store", "stove", "sink", "serving")
            return
        if goal & {"washed", "heated"}:
            self._have_done(name, WASH.name, "sink")
        if "heated" in goal:
            self._have_done(name, HEAT.name, "stove")
        if not self._picture.stands_in(name, "serving"):
            self._bring(name, "serving")

    def _have_done(self, name: str, deed: str, kind: str) -> None:
        if (name, deed) in self._picture.done:
            return
        if not self._picture.stands_in(name, kind):
            if self._picture.held is None:
                self._clear(name, kind)
            self._bring(name, kind)
        self.add(Action(deed, (name,)))

    def _clear(self, name: str, kind: str) -> None:
        """Put aside what leaves no room for something in any place of a kind."""
        where = [where for where, place in self._picture.places.items() if place.kind == kind]
        rng = np.random.default_rng(0)  # no spot is chosen here
        if not any(choose_spot(self._picture, name, place, FIRST_GAP, (), rng) for place in where):
            for other in list(self._picture.spots):
                if other != name and self._picture.stands_in(other, kind):
                    self._bring(other, "worktop", "store")

    def _bring(self, name: str, *kinds: str) -> None:
        """Move something into a place of the first of these kinds that has room for it; leave it where none has."""
        if self._picture.held != name:
            self.add(Action(PICK.name, (name,)))
        mine = [lesson for lesson in self._lessons if lesson.failed and lesson.failed.objects[0] == name]
        failed = [lesson.bad_spot for lesson in mine if lesson.bad_spot]
        gap = FIRST_GAP + GAP_STEP * sum(lesson.kind is FailureKind.GOAL_IN_COLLISION for lesson in mine)
        for kind in kinds:
            for where, place in self._picture.places.items():
                if place.kind == kind:
                    action = choose_spot(self._picture, name, where, gap, failed, self._rng)
                    if action:
                        self.add(action)
                        return
