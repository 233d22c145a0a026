"""What earlier attempts teach the stand-in: it reads which actions worked, and the kinds of failures."""

from __future__ import annotations

import json
from collections.abc import Iterable, Sequence
from dataclasses import dataclass

from llm3.parsing import parse_reply
from llm3.types import Action, Context, FailureKind, Feedback, Proposal, Sketch
from llm3_blocks.actions import PICK, PLACE, STACK


@dataclass(frozen=True)
class Lesson:
    """One earlier attempt."""

    worked: tuple[Action, ...]
    """The actions that worked, in order."""
    failed: Action | None
    kind: FailureKind | None
    """Why it failed, where the feedback tells."""

    @property
    def places(self) -> dict[str, Action]:
        """Where blocks could be put on the table, by name."""
        return {action.objects[0]: action for action in self.worked if action.name == PLACE.name}

    @property
    def touching(self) -> bool:
        """Whether something was in the way."""
        return self.kind in (FailureKind.GOAL_IN_COLLISION, FailureKind.NO_PATH)

    @property
    def failed_place(self) -> tuple[float, float] | None:
        """Where a block could not be put on the table."""
        if self.failed is None or self.failed.name != PLACE.name:
            return None
        return self.failed.params["x"], self.failed.params["y"]

    @property
    def crowded(self) -> bool:
        """Whether a block could not be taken, or put on another one, for what stands around."""
        return self.touching and self.failed is not None and self.failed.name != PLACE.name

    def began_with(self, moves: Sequence[Sketch]) -> bool:
        """Whether these were the actions that were tried."""
        tried = (*self.worked, self.failed) if self.failed else self.worked
        return all((a.name, a.objects) == (b.name, b.objects) for a, b in zip(tried, moves, strict=False))

    @property
    def is_about_motion(self) -> bool:
        """Whether an action failed, and not for what it presupposes."""
        return self.failed is not None and (self.kind is None or self.kind.is_motion)


def lessons_of(context: Context) -> tuple[Lesson, ...]:
    """What the trace teaches, the oldest first."""
    return tuple(_lesson(context, feedback) for feedback in context.trace if feedback.remarks)


def crowded(lessons: Iterable[Lesson], below: dict[str, str], spots: dict[str, tuple[float, float]]) -> set[str]:
    """The blocks at the bottom of towers that stood badly, so that they have to stand somewhere else.

    Args:
        lessons: What was learned.
        below: What each block of the goal has to stand on.
        spots: Where the lowest blocks stand at the start, by name.
    """
    found: set[str] = set()
    for lesson in lessons:
        if lesson.failed is None or not lesson.is_about_motion:
            continue
        name = lesson.failed.objects[0]
        if lesson.failed.name == STACK.name:
            found.add(_bottom(lesson.failed.objects[1], below))
        elif lesson.failed.name == PICK.name and lesson.touching and name in spots:
            others = [other for other in spots if other != name]
            x, y = spots[name]
            found |= {min(others, key=lambda o: (spots[o][0] - x) ** 2 + (spots[o][1] - y) ** 2)} if others else set()
    return found


def _bottom(name: str, below: dict[str, str]) -> str:
    while below.get(name) in below:
        name = below[name]
    return name


def _lesson(context: Context, feedback: Feedback) -> Lesson:
    worked: list[Action] = []
    for remark in feedback.remarks:
        action = _action(context, remark.action)
        if remark.verdict == "failed":
            return Lesson(tuple(worked), action, remark.kind)
        if action and remark.verdict == "feasible":
            worked.append(action)
    return Lesson(tuple(worked), None, None)


def _action(context: Context, text: str) -> Action | None:
    read = parse_reply(json.dumps({"Full Plan": [text]}), context.actions, context.objects)
    action = read.actions[0] if isinstance(read, Proposal) and read.actions else None
    return action if isinstance(action, Action) else None
