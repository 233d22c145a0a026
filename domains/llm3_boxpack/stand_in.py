"""A rule-based stand-in for a language model: rules of thumb for packing, and for learning from feedback.

It reads what a prompt tells and nothing else. Where that is how high the hand is, it reckons with it, see `careful`;
elsewhere it goes by experience: it does not know how far the arm reaches or how much room the fingers
really need: it starts with a guess, and corrects its plans as the feedback suggests.
"""

from __future__ import annotations

import json
from collections.abc import Sequence
from dataclasses import dataclass
from math import hypot, inf

import numpy as np

from llm3.parsing import parse_reply
from llm3.types import Action, Context, Entity, FailureKind, Feedback, Proposal
from llm3_boxpack.actions import PICK, PLACE
from llm3_boxpack.packing import Spot, Wishes, choose_spot

FIRST_GAP, GAP_STEP, LARGEST_GAP = 0.005, 0.015, 0.05
"""Free space between boxes in metres: the first guess, what a collision adds to it, and the most it asks for."""
REACH_STEP = 0.01
"""After a spot was out of reach, the next ones are this much closer to the arm, in metres."""
PATIENCE = 3
"""After so many failures in a row, the placement before the failed action is given up too."""


@dataclass(frozen=True)
class Lesson:
    """What an earlier attempt teaches."""

    placed: tuple[Action, ...]
    """The placements that worked, in order."""
    failed: Action | None
    kind: FailureKind | None
    """Why it failed, where the feedback tells."""

    @property
    def out_of_reach(self) -> bool:
        """Whether a placement failed because the arm does not get there."""
        return self.failed is not None and self.failed.name == PLACE.name and self.kind is FailureKind.UNREACHABLE

    @property
    def touching(self) -> bool:
        """Whether something was in the way."""
        return self.kind is FailureKind.GOAL_IN_COLLISION


def reply(context: Context, rng: np.random.Generator) -> str:
    """A reply in the format that the prompt asks for."""
    if not context.skeleton and any(entity.name == "hand" for entity in context.state):
        from llm3_boxpack.careful import careful_reply  # it is not cheap to import

        return careful_reply(context, rng)
    lessons = [_lesson(context, feedback) for feedback in context.trace if feedback.remarks]
    boxes = {entity.name: entity for entity in context.state if _is_box(entity, context)}
    kept, reasoning = _kept(lessons)
    spots = {a.objects[0]: _spot(a, boxes[a.objects[0]]) for a in kept}
    plan: list[Action] = []
    for name in _order(context, boxes, tuple(spots), lessons):
        if name not in spots:
            wishes = _wishes(name, lessons)
            spots[name] = choose_spot(_basket(context), _sides(boxes[name]), tuple(spots.values()), wishes, rng)
        spot = spots[name]
        plan.append(Action(PICK.name, (name,)))
        plan.append(Action(PLACE.name, (name,), {"x": spot.x, "y": spot.y, "theta": spot.theta}))
    return json.dumps({"Reasoning": reasoning, "Full Plan": [str(action) for action in plan]})


def _is_box(entity: Entity, context: Context) -> bool:
    return entity.name in context.objects and entity.properties.get("to be packed") != "no"


def _lesson(context: Context, feedback: Feedback) -> Lesson:
    placed: list[Action] = []
    for remark in feedback.remarks:
        action = _action(context, remark.action)
        if remark.verdict == "failed":
            return Lesson(tuple(placed), action, remark.kind)
        if action and action.name == PLACE.name and remark.verdict == "feasible":
            placed.append(action)
    return Lesson(tuple(placed), None, None)


def _action(context: Context, text: str) -> Action | None:
    read = parse_reply(json.dumps({"Full Plan": [text]}), context.actions, context.objects)
    action = read.actions[0] if isinstance(read, Proposal) and read.actions else None
    return action if isinstance(action, Action) else None


def _kept(lessons: Sequence[Lesson]) -> tuple[tuple[Action, ...], str]:
    """Which placements of the last plan to keep, and why."""
    if not lessons:
        return (), "There is no earlier plan. I put the large boxes into the corners first."
    last = lessons[-1]
    if last.failed is None:
        return (), "The last plan worked, but did not reach the goal. I choose all placements anew."
    why = f"The last plan failed at {last.failed}"
    why += ", because the spot is out of reach." if last.out_of_reach else ", because something is in the way."
    stuck = len(lessons) >= PATIENCE and all(lesson.placed == last.placed for lesson in lessons[-PATIENCE:])
    if stuck and last.placed:
        again = last.placed[-1].objects[0]
        return last.placed[:-1], f"{why} Other spots failed too, so I also put {again} elsewhere."
    return last.placed, f"{why} I keep what worked before it and choose another spot."


def _wishes(name: str, lessons: Sequence[Lesson]) -> Wishes:
    collisions = sum(lesson.touching for lesson in lessons)
    far = [lesson.failed for lesson in lessons if lesson.failed and lesson.out_of_reach]
    failed = [lesson.failed for lesson in lessons if lesson.failed and lesson.failed.name == PLACE.name]
    return Wishes(
        gap=min(FIRST_GAP + GAP_STEP * collisions, LARGEST_GAP),
        reach=min((hypot(a.params["x"], a.params["y"]) for a in far), default=inf) - REACH_STEP,
        failed=tuple((a.params["x"], a.params["y"]) for a in failed if a.objects[0] == name),
    )


def _order(
    context: Context, boxes: dict[str, Entity], kept: tuple[str, ...], lessons: Sequence[Lesson]
) -> tuple[str, ...]:
    """The given order, or: what is kept, then the rest from the largest to the smallest.

    A box that could not be picked up comes last: it may be free once others are gone.
    """
    if context.skeleton:
        return tuple(dict.fromkeys(sketch.objects[0] for sketch in context.skeleton))
    unpicked = {lesson.failed.objects[0] for lesson in lessons if lesson.failed and lesson.failed.name == PICK.name}
    rest = sorted((n for n in boxes if n not in kept), key=lambda n: (n in unpicked, -np.prod(_sides(boxes[n]))))
    return (*kept, *rest)


def _basket(context: Context) -> tuple[tuple[float, float], tuple[float, float]]:
    properties = next(entity.properties for entity in context.state if entity.name == "basket")
    return _pair(properties["x range"]), _pair(properties["y range"])


def _sides(box: Entity) -> tuple[float, float]:
    return _pair(box.properties["size"])


def _pair(property_: object) -> tuple[float, float]:
    if not isinstance(property_, tuple):
        raise TypeError(f"expected a tuple of numbers, not {property_!r}")
    return property_[0], property_[1]


def _spot(action: Action, box: Entity) -> Spot:
    theta = action.params["theta"]
    sides = _sides(box)
    covers = (sides[1], sides[0]) if abs(np.sin(theta)) > 0.5 else sides
    return Spot(action.params["x"], action.params["y"], theta, covers)
