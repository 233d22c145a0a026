"""Reading and comparing what plugins answer."""

from __future__ import annotations

import re
from collections.abc import Iterator, Mapping
from dataclasses import fields, is_dataclass
from typing import Any

import numpy as np

from llm3.testing.conformance.samples import samples, some_goals
from llm3.types import Failure, MotionProblem, NoMotion, Stats, Transition

_PROGRAMMER_TALK = re.compile(
    r"np\.(?:float|int|str|bool)|\barray\(|\bdtype=|<[\w.]+ object at 0x|\bnan\b|\bEntity\(|\bPose\(|\bFrozenDict\b"
)
LONGEST, BEFORE = 120, 40
"""How much is shown of a value, and how much of that before the first difference."""


def programmer_talk(text: str) -> str:
    """What in a text is written for a programmer and not for a model, such as ``np.float64``; empty if nothing is."""
    found = _PROGRAMMER_TALK.search(text)
    return found.group() if found else ""


def difference(one: Any, other: Any, name: str = "it") -> str:
    """Where two answers differ, as a phrase; empty where they are equal. What was spent may differ."""
    return next(_differences(one, other, name), "")


def _differences(one: Any, other: Any, name: str) -> Iterator[str]:
    if type(one) is not type(other):
        yield f"{name} is a {type(one).__name__} and then a {type(other).__name__}"
    elif isinstance(one, MotionProblem):
        yield from _problems(one, other)
    elif isinstance(one, np.ndarray):
        if not np.array_equal(one, other):
            yield f"{name} is {apart(one.tolist(), other.tolist())}"
    elif isinstance(one, Failure | Transition | NoMotion) or (is_dataclass(one) and not isinstance(one, type)):
        for field in fields(one):
            if not isinstance(getattr(one, field.name), Stats):
                yield from _differences(getattr(one, field.name), getattr(other, field.name), field.name)
    elif isinstance(one, Mapping) and set(one) == set(other):
        for key in one:
            yield from _differences(one[key], other[key], f"{name}[{key!r}]")
    elif one != other and repr(one) != repr(other):  # what is no number is not equal to itself
        yield f"{name} is {apart(one, other)}"


def _problems(one: MotionProblem, other: MotionProblem) -> Iterator[str]:
    for name in ("start", "low", "high", "resolution", "label", "before"):
        yield from _differences(getattr(one, name), getattr(other, name), name)
    pairs = zip(some_goals(one), some_goals(other), strict=False)
    for number, (a, b) in enumerate(pairs, start=1):
        yield from _differences(a, b, f"goal {number}")
    if len(some_goals(one)) != len(some_goals(other)):
        yield f"there are {len(some_goals(one))} goals and then {len(some_goals(other))}"
    at = samples(one)
    masks = np.asarray(one.valid(at)), np.asarray(other.valid(at))
    if masks[0].shape == masks[1].shape and (masks[0] != masks[1]).any():
        where = at[np.flatnonzero(masks[0] != masks[1])[0]]
        yield f"valid answers differently at {configuration(where)}"


def apart(one: Any, other: Any) -> str:
    """Two values in a sentence; of long ones what stands around the first difference."""
    texts = repr(one), repr(other)
    differ = next((i for i, (a, b) in enumerate(zip(*texts, strict=False)) if a != b), min(map(len, texts)))
    return " and then ".join(_cut(text, max(0, differ - BEFORE)) for text in texts)


def _cut(text: str, begin: int) -> str:
    if len(text) <= LONGEST:
        return text
    end = begin + LONGEST - 2
    return ("…" if begin else "") + text[begin:end] + ("…" if end < len(text) else "")


def configuration(values: Any) -> str:
    """A configuration in a sentence."""
    return "(" + ", ".join(f"{float(v):.4g}" for v in np.asarray(values).ravel()) + ")"
