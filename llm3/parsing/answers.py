"""Recognises the plan in a value that was read."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass

from llm3.parsing import keys, sentences
from llm3.parsing.reader import Reading
from llm3.parsing.values import Arguments, Bare, Items, Pairs, Value, written


@dataclass(frozen=True)
class Answer:
    """Something in a reply that holds a plan."""

    items: tuple[Value, ...] | None
    """The plan's items, not read yet. None: there is a plan, but it is no list."""
    reasoning: str
    repairs: tuple[str, ...]
    bare: bool = False
    """Whether it is the list of actions alone, with no object around it."""


def answers(reading: Reading) -> Iterator[Answer]:
    """The answers in a value, in the order of the text; what is inside an answer is not searched."""
    stack: list[Value | Arguments] = [reading.value]
    while stack:
        value = stack.pop()
        if isinstance(value, Items) and value.values and all(map(_is_like_an_action, value.values)):
            yield Answer(value.values, "", (*reading.liberties, sentences.BARE_LIST), bare=True)
        elif isinstance(value, Items):
            stack.extend(reversed(value.values))
        elif isinstance(value, Pairs):
            plan = _entry(value, keys.PLAN)
            if plan is None or _is_like_an_action(value):
                stack.extend(inner for _, inner in reversed(value.entries))
            else:
                reasoning = _entry(value, keys.REASONING)
                yield Answer(
                    plan.values if isinstance(plan, Items) else None,
                    "" if reasoning is None else written(reasoning),
                    reading.liberties,
                )


def best(found: list[Answer]) -> Answer | None:
    """The last object with a plan; failing that, the last bare list; failing that, a plan that is no list."""
    lists = [answer for answer in found if answer.items is not None]
    objects = [answer for answer in lists if not answer.bare]
    return next((group[-1] for group in (objects, lists, found) if group), None)


def _entry(pairs: Pairs, names: tuple[str, ...]) -> Value | None:
    """The value of the first of these keys that is there, a list before anything else; of equal keys the last."""
    by_key = {keys.plain(key): value for key, value in pairs.entries}
    values = [by_key[name] for name in names if name in by_key]
    return next((value for value in values if isinstance(value, Items)), values[0] if values else None)


def _is_like_an_action(value: Value) -> bool:
    """Whether this could be an item of a plan: chatter holds lists of names, numbers and descriptions as well."""
    if isinstance(value, str | Bare):
        return "(" in written(value)
    if isinstance(value, Items):
        return False
    texts = {keys.plain(key) for key, inner in value.entries if isinstance(inner, str | Bare)}
    present = {keys.plain(key) for key, _ in value.entries}
    return bool(texts & {*keys.ACTION}) or ("name" in texts and bool(present & {*keys.OBJECTS, *keys.PARAMETERS}))
