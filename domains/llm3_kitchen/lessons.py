"""What the stand-in learns from the feedback on its earlier plans."""

from __future__ import annotations

import json
import re
from collections.abc import Container, Sequence
from dataclasses import dataclass

from llm3.parsing import parse_reply
from llm3.types import Action, Context, FailureKind, Feedback, Proposal
from llm3_kitchen.actions import PICK, PLACE
from llm3_kitchen.picture import Pair

PATIENCE = 4
"""After so many failures in a row behind the same beginning, the last move of that beginning is given up too."""


@dataclass(frozen=True)
class Lesson:
    """What an earlier attempt teaches."""

    worked: tuple[Action, ...]
    """The actions that worked, in order."""
    failed: Action | None
    kind: FailureKind | None = None
    """Why it failed, where the feedback tells."""
    named: tuple[str, ...] = ()
    """The objects that the feedback names as it tells why, in its order."""

    @property
    def bad_spot(self) -> Pair | None:
        """Where the thing that could not be put down, or taken again, was put down."""
        if self.failed is None:
            return None
        name, tries = self.failed.objects[0], (*self.worked, self.failed)
        placed = [a for a in tries if a.name == PLACE.name and a.objects[0] == name]
        return (placed[-1].params["x"], placed[-1].params["y"]) if placed else None

    @property
    def beginning(self) -> tuple[Action, ...]:
        """What worked, without the last move."""
        picks = [index for index, action in enumerate(self.worked) if action.name == PICK.name]
        return self.worked[: picks[-1]] if picks else ()


def lessons_of(context: Context, things: Container[str]) -> list[Lesson]:
    """A lesson for each earlier attempt whose plan could be read, the oldest first.

    Args:
        context: What the prompt tells.
        things: The names of what can be moved; plans of others may do something with a place.
    """
    return [_lesson(context, things, feedback) for feedback in context.trace if feedback.remarks]


def is_stuck(lessons: Sequence[Lesson]) -> bool:
    """Whether other ways to go on did not help either."""
    last = lessons[-PATIENCE:]
    return len(last) == PATIENCE and all(lesson.worked == last[-1].worked for lesson in last)


def _lesson(context: Context, things: Container[str], feedback: Feedback) -> Lesson:
    worked: list[Action] = []
    for remark in feedback.remarks:
        action = _action(context, things, remark.action)
        if remark.verdict != "feasible" or action is None:
            words = re.findall(r"\w+", remark.text)
            named = tuple(word for word in dict.fromkeys(words) if word in context.objects)
            return Lesson(tuple(worked), action, remark.kind, named)
        worked.append(action)
    return Lesson(tuple(worked), None)


def _action(context: Context, things: Container[str], text: str) -> Action | None:
    """An action on a thing; None for anything else."""
    read = parse_reply(json.dumps({"Full Plan": [text]}), context.actions, context.objects)
    action = read.actions[0] if isinstance(read, Proposal) and read.actions else None
    return action if isinstance(action, Action) and action.objects[0] in things else None
