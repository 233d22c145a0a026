"""The front door of the parser."""

from __future__ import annotations

from collections.abc import Sequence

from llm3.parsing import sentences
from llm3.parsing.checks import faults
from llm3.parsing.drafts import draft
from llm3.parsing.search import find_answer
from llm3.parsing.sequence import follow
from llm3.parsing.values import Value, written
from llm3.types import Action, ActionSchema, Failure, FailureKind, Proposal, Rejected, Sketch

MAX_CHARACTERS = 200_000
"""Longer replies are refused unread."""
MAX_ACTIONS = 200
"""Longer plans are refused before their actions are read."""


def parse_reply(
    text: str,
    schemas: Sequence[ActionSchema],
    objects: Sequence[str],
    skeleton: Sequence[Sketch] = (),
    *,
    cut_off: bool = False,
) -> Proposal | Failure:
    """Read the plan in a model's reply.

    The asked-for form is ``{"Reasoning": "…", "Full Plan": ["pick(['red_box'], {})", …]}``. Of several plans in a
    reply the last complete one counts. Liberties of form are taken where one reading is possible, those with the
    JSON are listed in `Proposal.repairs`; values are never changed.

    Args:
        text: The reply, any string at all.
        schemas: The valid actions, with the ranges of their parameters.
        objects: The names that actions may take.
        skeleton: The given action sequence, where the model chooses the parameters only.
        cut_off: Whether the reply ends where the model was stopped for its length.

    Returns:
        The plan, with a `Rejected` (`INVALID_ACTION`) in the place of each item that is no valid action; or an
        `UNREADABLE_REPLY` failure. Either carries its reason as a sentence for the model.
    """
    if len(text) > MAX_CHARACTERS:
        return _unreadable(sentences.too_long(len(text), MAX_CHARACTERS))
    if not text.strip():
        return _unreadable(sentences.CUT_OFF if cut_off else sentences.EMPTY)
    found = find_answer(text, cut_off)
    if found is None:
        return _unreadable(sentences.CUT_OFF if cut_off else sentences.NO_PLAN)
    if found.items is None:
        return _unreadable(sentences.PLAN_IS_NO_LIST)
    if len(found.items) > MAX_ACTIONS:
        return _unreadable(sentences.too_many_actions(len(found.items), MAX_ACTIONS))
    by_name = {schema.name: schema for schema in schemas}
    actions = tuple(_read_item(item, by_name, objects) for item in found.items)
    return Proposal(follow(skeleton, actions) if skeleton else actions, found.reasoning, found.repairs)


def _unreadable(sentence: str) -> Failure:
    return Failure(FailureKind.UNREADABLE_REPLY, detail=sentence)


def _read_item(item: Value, schemas: dict[str, ActionSchema], objects: Sequence[str]) -> Action | Rejected:
    drafted = draft(item, schemas)
    if drafted is None:
        problems = [sentences.unreadable_item(written(item), tuple(schemas.values()))]
    else:
        checked = faults(drafted, schemas, objects)
        if isinstance(checked, Action):
            return checked
        problems = checked
    failure = Failure(FailureKind.INVALID_ACTION, detail=sentences.joined(problems))
    return Rejected(sentences.cut(written(item)), failure)
