"""The keys of an answer and of an action, however a model spells them."""

from __future__ import annotations

import re

_SIGNS = re.compile(r"[\W_]+")

PLAN = ("fullplan", "plan", "actionplan", "actionsequence", "action")
REASONING = ("reasoning", "reason")
ACTION = ("action", "actionname")
NAME = (*ACTION, "name")
OBJECTS = ("object", "arg", "argument")
PARAMETERS = ("parameter", "param")


def plain(key: str) -> str:
    """A key without its case, spaces, signs and plural: ``"Full Plans"`` and ``full_plan`` are the same."""
    return _SIGNS.sub("", key).casefold().removesuffix("s")
