"""What the nouns demand of their fields, in sentences for whoever writes a plugin."""

from __future__ import annotations

from collections.abc import Iterable
from math import isfinite
from typing import Any


def texts(field: str, values: Any) -> tuple[str, ...]:
    """The values as a tuple of texts.

    Raises:
        TypeError: They are one text, whose characters would pass for them, or some are no texts.
    """
    if isinstance(values, str) or not isinstance(values, Iterable):
        raise TypeError(f"{field} must be a tuple of texts, not {values!r}; write ({values!r},)")
    found = tuple(values)
    for value in found:
        if not isinstance(value, str):
            raise TypeError(f"{field} must be a tuple of texts, and {value!r} is none")
    return found


def finite(field: str, values: Iterable[float]) -> tuple[float, ...]:
    """The values as a tuple of floats.

    Raises:
        ValueError: One is infinite or not a number.
    """
    found = tuple(float(value) for value in values)
    if not all(map(isfinite, found)):
        raise ValueError(f"{field} must be finite numbers, not {found}")
    return found
