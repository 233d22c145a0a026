"""Holds a plan against a given action sequence."""

from __future__ import annotations

from collections.abc import Sequence

from llm3.parsing import sentences
from llm3.types import Action, Failure, FailureKind, Rejected, Sketch


def follow(skeleton: Sequence[Sketch], actions: tuple[Action | Rejected, ...]) -> tuple[Action | Rejected, ...]:
    """The plan, with a `Rejected` where it first departs from the skeleton.

    Items that were rejected before hold their place. A plan that is too short gets the `Rejected` behind its end.
    """
    for place, item in enumerate(actions):
        if place >= len(skeleton):
            detail = sentences.one_too_many(place + 1, str(item), len(skeleton))
        elif isinstance(item, Rejected) or Sketch(item.name, item.objects) == skeleton[place]:
            continue
        else:
            detail = sentences.departs(place + 1, skeleton[place], Sketch(item.name, item.objects))
        return (*actions[:place], _rejected(str(item), detail), *actions[place + 1 :])
    if len(actions) < len(skeleton):
        missing = sentences.too_short(len(actions) + 1, skeleton[len(actions)])
        return (*actions, _rejected(sentences.END_OF_PLAN, missing))
    return actions


def _rejected(text: str, detail: str) -> Rejected:
    return Rejected(sentences.cut(text), Failure(FailureKind.INVALID_ACTION, detail=detail))
