"""What a reply is made of, before anything is known of its meaning."""

from __future__ import annotations

import math
import re
from dataclasses import dataclass

_NUMBER = re.compile(r"[-+]?(?:[0-9]+(?:\.[0-9]*)?|\.[0-9]+)(?:[eE][-+]?[0-9]+)?")


@dataclass(frozen=True)
class Bare:
    """Text without quotes: a number, a literal such as ``true``, a name, or a call with all its arguments."""

    text: str


@dataclass(frozen=True)
class Items:
    """A list or a tuple."""

    values: tuple[Value, ...]
    source: str
    """The text that it was read from."""


@dataclass(frozen=True)
class Pairs:
    """A JSON object or a dict; keys may occur twice, in order."""

    entries: tuple[tuple[str, Value], ...]
    source: str
    """The text that it was read from."""


@dataclass(frozen=True)
class Arguments:
    """What stands between the brackets of a call."""

    positional: tuple[Value, ...]
    keywords: tuple[tuple[str, Value], ...]


Value = str | Bare | Items | Pairs
"""A ``str`` is text that stood in quotes."""


def written(value: Value) -> str:
    """The value as the model wrote it; text in quotes without them."""
    if isinstance(value, str):
        return value
    return value.text if isinstance(value, Bare) else value.source


def is_number(text: str) -> bool:
    """Whether this is a plain decimal number: no arithmetic, no names such as ``nan`` or ``inf``."""
    return _NUMBER.fullmatch(text) is not None


def number(value: Value) -> float | None:
    """The finite number that is written here, also in quotes (``"0.5"`` has one reading only), or None."""
    text = written(value).strip() if isinstance(value, str | Bare) else ""
    figure = float(text) if is_number(text) else math.nan
    return figure if math.isfinite(figure) else None
