"""From an item of a plan to what it says: an action's name, objects and parameters, none of them checked."""

from __future__ import annotations

import re
from collections.abc import Collection, Iterable
from dataclasses import dataclass

from llm3.parsing import keys
from llm3.parsing.reader import Unreadable, read
from llm3.parsing.values import Arguments, Bare, Items, Pairs, Value, written

_BRACKET = re.compile(r"\s*\(")
_NUMBERING = re.compile(r"\s*(?:(?:(?:step|action)\s*)?[0-9]+\s*[.):]|[-*•])\s*", re.IGNORECASE)


@dataclass(frozen=True)
class Draft:
    """An action as the model means it."""

    name: str
    objects: tuple[Value, ...]
    params: tuple[tuple[str, Value], ...]


def draft(item: Value, names: Collection[str]) -> Draft | None:
    """What an item says, or None if it cannot be read as an action.

    Args:
        item: A call such as ``place(['red_box'], {'x': 0.5})``, or an object with a name, objects and parameters.
        names: The valid actions. A name that holds brackets or spaces is recognised by being one of them.
    """
    if isinstance(item, Items):
        return None
    if not isinstance(item, Pairs):
        return _from_text(written(item), names)
    heads, objects, params = _sorted(item.entries)
    if len(heads) != 1 or not isinstance(heads[0], str | Bare):
        return None
    name = written(heads[0])
    if not objects and not params and "(" in name:
        return _from_text(name, names)
    return Draft(name, objects, params)


def _from_text(text: str, names: Collection[str]) -> Draft | None:
    if text.strip() in names:
        return Draft(text.strip(), (), ())
    head = _head(text, names)
    if head is None:
        return None
    name, bracket = head
    try:
        reading = read(text, bracket)
    except Unreadable:
        return None
    tail = text[reading.end :].strip().lstrip(",;.").lstrip()
    if (tail and not tail.startswith(("#", "//"))) or not isinstance(reading.value, Arguments):
        return None
    return _from_arguments(name, reading.value)


def _head(text: str, names: Collection[str]) -> tuple[str, int] | None:
    """The action's name and the position of the bracket behind it."""
    numbering = _NUMBERING.match(text)
    starts = [0] if numbering is None else [0, numbering.end()]
    for start in starts:
        for name in sorted(names, key=len, reverse=True):
            if text.startswith(name, start) and (match := _BRACKET.match(text, start + len(name))):
                return name, match.end() - 1
    bracket = text.find("(")
    name = text[starts[-1] : bracket].strip()
    return (name, bracket) if bracket >= 0 and len(name.split()) == 1 else None


def _from_arguments(name: str, arguments: Arguments) -> Draft | None:
    objects: list[Value] = []
    params: list[tuple[str, Value]] = []
    for value in arguments.positional:
        if isinstance(value, Pairs):
            params += value.entries
        elif not _is_nothing(value):
            objects += _each(value)
    heads, more_objects, more_params = _sorted(arguments.keywords)
    return None if heads else Draft(name, (*objects, *more_objects), (*params, *more_params))


def _sorted(
    entries: Iterable[tuple[str, Value]],
) -> tuple[list[Value], tuple[Value, ...], tuple[tuple[str, Value], ...]]:
    """Entries by what their keys announce: names, objects, parameters. Any other key is itself a parameter."""
    heads: list[Value] = []
    objects: list[Value] = []
    params: list[tuple[str, Value]] = []
    for key, value in entries:
        plain = keys.plain(key)
        if plain in keys.NAME:
            heads.append(value)
        elif plain in keys.OBJECTS + keys.PARAMETERS and isinstance(value, Pairs):
            params += value.entries
        elif plain in keys.OBJECTS:
            objects += _each(value)
        elif plain not in keys.PARAMETERS or not _is_nothing(value):
            params.append((key, value))
    return heads, tuple(objects), tuple(params)


def _each(value: Value) -> tuple[Value, ...]:
    return value.values if isinstance(value, Items) else (value,)


def _is_nothing(value: Value) -> bool:
    return isinstance(value, Bare) and value.text in ("None", "null")
