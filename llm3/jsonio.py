"""JSON in and out: canonical text for dataclasses, and strict reading that names the field that is wrong."""

from __future__ import annotations

import json
from collections.abc import Mapping
from dataclasses import fields, is_dataclass
from pathlib import Path
from typing import Any, TypeVar

import msgspec
import numpy as np

from llm3.errors import InputError, LLM3Error
from llm3.json_faults import told

T = TypeVar("T")


def _plain(value: Any) -> Any:
    if isinstance(value, np.ndarray):
        return value.tolist()
    if isinstance(value, np.generic):
        return value.item()
    raise TypeError(f"{type(value).__name__} has no JSON form")


def dumps(value: Any) -> str:
    """One line of JSON with sorted keys: equal values give equal text.

    Raises:
        TypeError: Something inside has no JSON form.
    """
    return msgspec.json.encode(value, enc_hook=_plain, order="sorted").decode()


def unsorted(value: Any) -> str:
    """One line of JSON with fields in their own order, such as the parameters of an action as they are written.

    Raises:
        TypeError: Something inside has no JSON form.
    """
    return msgspec.json.encode(value, enc_hook=_plain).decode()


def pretty(value: Any) -> str:
    """JSON for people: fields in their own order, indented, with a newline at the end."""
    return msgspec.json.format(msgspec.json.encode(value, enc_hook=_plain), indent=2).decode() + "\n"


def to_builtins(value: Any) -> Any:
    """Dicts, lists, strings, numbers, booleans and None."""
    return msgspec.json.decode(msgspec.json.encode(value, enc_hook=_plain))


def loads(text: str | bytes, type_: type[T], source: str) -> T:
    """Read JSON into a dataclass, strictly.

    Args:
        text: The JSON.
        type_: What it should hold. A ValueError of its `__post_init__` becomes part of the message.
        source: Where the text comes from, for the message.

    Raises:
        InputError: One line that names the source, the field and what is wrong with it.
    """
    try:
        text = text.decode("utf-8-sig") if isinstance(text, bytes) else text
        if not text.strip():
            raise InputError(f"{source}: empty")
        value = msgspec.json.decode(text, type=type_)
        json.loads(text, object_pairs_hook=_without_doubles)
        _set_defaults(value)
        wrong = _unknown_field(msgspec.json.decode(text), to_builtins(value), "$")
    except (UnicodeDecodeError, UnicodeEncodeError) as error:
        raise InputError(f"{source}: not UTF-8 text: {error.reason} at byte {error.start}") from error
    except _DoubleKey as error:
        raise InputError(f"{source}: the field `{error}` stands there twice") from error
    except RecursionError as error:
        raise InputError(f"{source}: nested too deeply") from error
    except msgspec.MsgspecError as error:
        assert isinstance(text, str)  # noqa: S101  # it was decoded above
        wrong = told(str(error), text, type_)
    if wrong:
        raise InputError(f"{source}: {wrong}")
    return value


class _DoubleKey(Exception):  # it never leaves this module
    pass


def _without_doubles(pairs: list[tuple[str, Any]]) -> None:
    """Refuse an object that says one thing twice, of which JSON parsers take the last in silence."""
    seen = set()
    for key, _ in pairs:
        if key in seen:
            raise _DoubleKey(key)
        seen.add(key)


def _set_defaults(value: Any) -> None:
    """Set the fields that were not in the text.

    msgspec leaves them to the class's defaults and writes only what an instance holds itself: without this, the text
    of a value that was read would differ from that of an equal one that was made.
    """
    if is_dataclass(value):
        for field in fields(value):
            child = getattr(value, field.name)
            object.__setattr__(value, field.name, child)
            _set_defaults(child)
    elif isinstance(value, Mapping):
        for child in value.values():
            _set_defaults(child)
    elif isinstance(value, (list, tuple)):
        for child in value:
            _set_defaults(child)


def _unknown_field(raw: Any, known: Any, where: str) -> str:
    """Which field of the raw JSON the dataclass does not have; msgspec passes over those in silence."""
    if isinstance(raw, dict) and isinstance(known, dict):
        for key, value in raw.items():
            if key not in known:
                return f"unknown field `{key}`, expected {', '.join(known)} - at `{where}`"
            if found := _unknown_field(value, known[key], f"{where}.{key}"):
                return found
    elif isinstance(raw, list) and isinstance(known, list):
        for index, (value, other) in enumerate(zip(raw, known, strict=False)):
            if found := _unknown_field(value, other, f"{where}[{index}]"):
                return found
    return ""


def read_file(path: Path, type_: type[T]) -> T:
    """Read a JSON file into a dataclass; see :func:`loads`.

    Raises:
        InputError: The file cannot be read or does not hold such a thing.
    """
    try:
        data = path.read_bytes()
    except OSError as error:
        raise InputError(f"{path}: {error.strerror or error}") from error
    return loads(data, type_, str(path))


def read_stated(path: Path, type_: type[T], format_: str) -> T:
    """Read a JSON file that says of what format it is; see :func:`loads`.

    Raises:
        InputError: The file cannot be read, is of another format or of none, or does not hold such a thing.
    """
    try:
        return read_file(path, type_)
    except LLM3Error as error:
        stated = _stated(path, format_)
        if stated != format_:
            found = "no format is stated" if stated is None else f"the format is {stated!r}"
            raise InputError(f"{path}: {found}, and this version reads {format_!r}") from None
        if isinstance(error, InputError):
            raise
        raise InputError(f"{path}: {error}") from error  # fields that are well formed and cannot be


def _stated(path: Path, usual: Any) -> Any:
    """What a JSON file says that its format is; the usual one if there is no reading it."""
    try:
        data = json.loads(path.read_bytes())
    except (OSError, ValueError, RecursionError):
        return usual
    return data.get("format") if isinstance(data, dict) else usual
