"""What is wrong with a JSON text: the parser's sentence, with the place and the valid values made plain."""

from __future__ import annotations

import re
from collections.abc import Iterator, Sequence
from typing import Any

import msgspec
from msgspec import inspect

LONGEST = 40
"""Characters of a wrong value that a sentence quotes."""
_BYTE = re.compile(r" \(byte (\d+)\)$")
_PLACED = re.compile(r"(?P<fault>.*?)(?: - at `\$(?P<path>.*)`)?", re.DOTALL)
_TYPE = re.compile(r"Expected `[\w |]+`, got `(?P<got>\w+)`")
_LENGTH = re.compile(r"Expected `array` of length \d+")
_STEP = re.compile(r"\.(?P<field>\w+)|\[(?P<index>\d+|\.\.\.)\]")


def told(sentence: str, text: str, type_: Any) -> str:
    """The parser's sentence in the terms of whoever wrote the text.

    Args:
        sentence: What the parser says.
        text: The JSON.
        type_: What it should hold.
    """
    if byte := _BYTE.search(sentence):
        return f"{sentence[: byte.start()]} ({_place(text, int(byte.group(1)))})"
    parts = _PLACED.fullmatch(sentence)
    fault, path = (parts["fault"], parts["path"] or "") if parts else (sentence, "")
    if fault.startswith("Invalid enum value"):
        valid = ", ".join(map(repr, _valid(inspect.type_info(type_), path)))
        return f"{sentence}; valid: {valid}" if valid else sentence
    return _with_what_is_there(fault, text, path) or sentence


def _with_what_is_there(fault: str, text: str, path: str) -> str:
    """The fault with the value that is wrong, or with its length; empty where this cannot be told."""
    steps = [step["field"] or step["index"] for step in _STEP.finditer(path)]
    try:
        places = list(_places(msgspec.json.decode(text), steps))
    except (msgspec.MsgspecError, RecursionError):  # further on it may be no JSON
        return ""
    wrong_type, wrong_length = _TYPE.fullmatch(fault), _LENGTH.fullmatch(fault)
    for place, found in places:
        where = f" - at `${place}`" if place else ""
        if wrong_type and type(found).__name__ == wrong_type["got"]:
            return f"{fault} {_short(msgspec.json.encode(found).decode())}{where}"
        if wrong_length and isinstance(found, list):
            return f"{fault}, got {len(found)}{where}"
    return ""


def _places(value: Any, steps: Sequence[str], place: str = "") -> Iterator[tuple[str, Any]]:
    """What stands where a path leads; several where it goes through any value of an object."""
    if not steps:
        yield place, value
    elif isinstance(value, list) and steps[0].isdigit() and int(steps[0]) < len(value):
        yield from _places(value[int(steps[0])], steps[1:], f"{place}[{steps[0]}]")
    elif isinstance(value, dict):
        for key in value if steps[0] == "..." else {steps[0]} & value.keys():
            yield from _places(value[key], steps[1:], f"{place}.{key}")


def _short(value: str) -> str:
    return value if len(value) <= LONGEST else f"{value[:LONGEST]}…"


def _place(text: str, byte: int) -> str:
    """Lines and columns count from 1; of a text of one line there is no need to name the line."""
    before = text.encode(errors="replace")[:byte].decode(errors="replace")
    line, column = before.count("\n") + 1, len(before) - before.rfind("\n")
    return f"line {line}, column {column}" if "\n" in text.strip() else f"column {column}"


def _valid(kind: inspect.Type, path: str) -> tuple[Any, ...]:
    """What may stand at a place; empty where that is not known."""
    for step in _STEP.finditer(path):
        kinds = [_inner(one, step["field"], step["index"]) for one in _alternatives(kind)]
        found = next((inner for inner in kinds if inner is not None), None)
        if found is None:
            return ()
        kind = found
    values: list[Any] = []
    for one in _alternatives(kind):
        if isinstance(one, inspect.LiteralType):
            values += one.values
        elif isinstance(one, inspect.EnumType):
            values += [member.value for member in one.cls]
    return tuple(values)


def _alternatives(kind: inspect.Type) -> tuple[inspect.Type, ...]:
    return kind.types if isinstance(kind, inspect.UnionType) else (kind,)


def _inner(kind: inspect.Type, field: str | None, index: str | None) -> inspect.Type | None:
    if isinstance(kind, inspect.DataclassType | inspect.StructType) and field is not None:
        return next((one.type for one in kind.fields if one.encode_name == field), None)
    if isinstance(kind, inspect.VarTupleType | inspect.ListType) and index is not None:
        return kind.item_type
    if isinstance(kind, inspect.TupleType) and index is not None and index.isdigit():
        return kind.item_types[int(index)]
    if isinstance(kind, inspect.DictType) and index is not None:
        return kind.value_type
    return None
