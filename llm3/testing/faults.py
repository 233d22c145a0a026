"""Faults of a reply: what a model may write instead of a good plan."""

from __future__ import annotations

import json
import re
from collections.abc import Callable, Mapping
from contextlib import suppress
from dataclasses import replace
from types import MappingProxyType
from typing import Any

import numpy as np

from llm3.types import Completion

Fault = Callable[[Completion, Completion, np.random.Generator], Completion]
"""Makes a bad reply of the good one, the reply before it (in a first turn the good one again) and a generator."""

ENDLESS = 100_000
"""Actions of the endless plan."""
PROSE = "I would first clear what is in the way, and then go on to the goal step by step."
REFUSAL = "I'm sorry, but I can't help with that."
_ACTION = re.compile(r"\w+\([^()]*\)")
_UNESCAPED_QUOTE = re.compile(r'(?<!\\)"')
_NUMBER = re.compile(r"(?<=[:=])(\s*)[+-]?\.?\d[\w.+-]*")


def _without_a_quote(good: Completion, _: Completion, rng: np.random.Generator) -> Completion:
    quotes = [found.start() for found in _UNESCAPED_QUOTE.finditer(good.text)]
    if not quotes:
        return replace(good, text="{" + good.text)
    at = quotes[rng.integers(len(quotes))]
    return replace(good, text=good.text[:at] + good.text[at + 1 :])


def _cut_off(good: Completion, _: Completion, rng: np.random.Generator) -> Completion:
    length = int(rng.integers(max(1, len(good.text.rstrip()))))
    return replace(good, text=good.text[:length], finish_reason="length")


def _prose(good: Completion, _: Completion, __: np.random.Generator) -> Completion:
    return replace(good, text=PROSE)


def _refusal(good: Completion, _: Completion, __: np.random.Generator) -> Completion:
    return replace(good, text=REFUSAL, finish_reason="refusal")


def _empty(good: Completion, _: Completion, __: np.random.Generator) -> Completion:
    return replace(good, text="")


def _again(good: Completion, before: Completion, _: np.random.Generator) -> Completion:
    return replace(good, text=before.text)


def _endless(good: Completion, _: Completion, __: np.random.Generator) -> Completion:
    return _planning(good, [min(_plan(good.text), key=len)] * ENDLESS)


def _spoiling(spoil: Callable[[str], str]) -> Fault:
    """The fault that spoils one action of the plan, any that can be spoilt."""

    def fault(good: Completion, _: Completion, rng: np.random.Generator) -> Completion:
        plan = _plan(good.text)
        places = [n for n, action in enumerate(plan) if spoil(action) != action]
        if not places:  # no parameter in the whole plan
            plan, places = [*plan, "wait([], {'seconds': 1})"], [len(plan)]
        at = places[rng.integers(len(places))]
        plan[at] = spoil(plan[at])
        return _planning(good, plan)

    return fault


def _with_another_object(action: str) -> str:
    return re.sub(r"\(\[([^]]*)\]", lambda m: f"([{m[1]}, {m[1]}]" if m[1].strip() else "(['thing']", action, count=1)


def _of_an_unknown_object(action: str) -> str:
    return re.sub(r"\(\[[^],]*", "(['no_such_object'", action, count=1)


def _with_number(text: str) -> Callable[[str], str]:
    return lambda action: _NUMBER.sub(rf"\g<1>{text}", action, count=1)


def _plan(text: str) -> list[str]:
    """The actions of a reply, as texts of the form ``name([objects], {parameters})``; one made up if there is none."""
    document: Any = None
    with suppress(ValueError, RecursionError):
        document = json.loads(text)
    items = document.get("Full Plan") if isinstance(document, dict) else document
    if not isinstance(items, list):
        items = _ACTION.findall(text.rpartition('"Full Plan"')[2])
    return [item for item in items if isinstance(item, str)] or ["wait([], {'seconds': 1})"]


def _planning(good: Completion, plan: list[str]) -> Completion:
    return replace(good, text=json.dumps({"Reasoning": "This should do.", "Full Plan": plan}))


REPLY_FAULTS: Mapping[str, Fault] = MappingProxyType(
    {
        "invalid JSON": _without_a_quote,
        "truncated JSON": _cut_off,
        "prose only": _prose,
        "refusal": _refusal,
        "empty": _empty,
        "wrong number of objects": _spoiling(_with_another_object),
        "unknown object": _spoiling(_of_an_unknown_object),
        "NaN": _spoiling(_with_number("NaN")),
        "out of range": _spoiling(_with_number("1e9")),
        "same plan again": _again,
        "endless plan": _endless,
    }
)
"""Every fault of a reply by its name."""
