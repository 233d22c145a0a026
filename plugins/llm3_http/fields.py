"""Taking a stranger's JSON apart: what is not there, or not of its type, reads as nothing."""

from __future__ import annotations

from collections.abc import Collection, Mapping
from typing import Any


def mapping(value: object) -> Mapping[str, Any]:
    """The object, or an empty one."""
    return value if isinstance(value, dict) else {}


def text_of(document: Mapping[str, Any], name: str) -> str:
    """A field that is a text, or an empty one."""
    value = document.get(name)
    return value if isinstance(value, str) else ""


MOST = 10**12
"""No model reads or writes so many tokens at a time: a larger number is none."""


def count(document: Mapping[str, Any], name: str) -> int:
    """A field that is a whole number from 0 to `MOST`, or 0."""
    value = document.get(name)
    return value if isinstance(value, int) and not isinstance(value, bool) and 0 <= value <= MOST else 0


def texts_of(content: object, types: Collection[str]) -> str:
    """The texts of those parts of a message that have one of these types; a part that states none is a text."""
    parts = [mapping(part) for part in content] if isinstance(content, list) else []
    wanted = [part for part in parts if part and part.get("type", "text") in types]
    return "".join(text_of(part, "text") or text_of(part, "thinking") for part in wanted)
