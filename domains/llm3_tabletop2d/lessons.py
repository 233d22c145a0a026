"""What a prompt tells of earlier attempts, for the stand-in."""

from __future__ import annotations

import json
from dataclasses import dataclass

from llm3.parsing import parse_reply
from llm3.types import Action, Context, FailureKind, Feedback, Proposal


@dataclass(frozen=True)
class Lesson:
    """What an earlier attempt teaches."""

    worked: tuple[Action, ...]
    """The actions that worked, in order."""
    failed: Action | None
    kind: FailureKind | None
    """Why it failed, where the feedback tells."""


def lessons_of(context: Context) -> list[Lesson]:
    """One for each earlier attempt that tells of its actions."""
    return [_lesson(context, feedback) for feedback in context.trace if feedback.remarks]


def _lesson(context: Context, feedback: Feedback) -> Lesson:
    worked: list[Action] = []
    for remark in feedback.remarks:
        action = _action(context, remark.action)
        if action is None or remark.verdict != "feasible":
            return Lesson(tuple(worked), action if remark.verdict == "failed" else None, remark.kind)
        worked.append(action)
    return Lesson(tuple(worked), None, None)


def _action(context: Context, text: str) -> Action | None:
    read = parse_reply(json.dumps({"Full Plan": [text]}), context.actions, context.objects)
    action = read.actions[0] if isinstance(read, Proposal) and read.actions else None
    return action if isinstance(action, Action) else None
