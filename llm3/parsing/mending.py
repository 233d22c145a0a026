"""What is tried with a reply that cannot be read as it is."""

from __future__ import annotations

import json
import re

from json_repair import repair_json

from llm3.parsing import sentences

MAX_CHARACTERS = 8_000
"""json-repair is slow on long text: it sees no more than this."""
MAX_DEPTH = 20
"""It calls itself for each nested bracket: it sees no more than this."""

_ANSWER = re.compile(r"\{[ \t\r\n]{0,80}[\"'“”‘’]?(?:reasoning|full[ _-]?plan|plan|actions)\b", re.IGNORECASE)
_CALL_OPENS = re.compile(r"\"(?=[A-Za-z_][\w.-]{0,80}\()")
_CALL_CLOSES = re.compile(r"\)\"")


def without_quotes_around_calls(text: str) -> tuple[str, tuple[str, ...]]:
    """The text with ``"pick(["red_box"], {})"`` made ``pick(["red_box"], {})``.

    Quotes inside quotes without an escape are the commonest damage, and nothing but the outer pair is to blame.
    """
    return _CALL_CLOSES.sub(")", _CALL_OPENS.sub("", text)), (sentences.UNESCAPED_QUOTES,)


def mended(text: str) -> tuple[str, tuple[str, ...]]:
    """The text's last answer as JSON by json-repair, and what that library says it did.

    The result is text again, to be read and checked like any other: the library makes text of whatever it cannot read,
    such as ``3.14/2``. Both are empty where there is nothing that looks like an answer, or too much of it.
    """
    start = max((match.start() for match in _ANSWER.finditer(text)), default=len(text))
    damaged = text[start:].partition("```")[0]  # chatter behind a fence is no part of the answer
    if not damaged or len(damaged) > MAX_CHARACTERS or _depth(damaged) > MAX_DEPTH:
        return "", ()
    try:
        value, log = repair_json(damaged, skip_json_loads=True, logging=True)
        steps = dict.fromkeys(entry["text"] for entry in log)
        return json.dumps(value, ensure_ascii=False), tuple(f"json-repair: {step}" for step in steps)
    except Exception:  # a library on damaged text: whatever it stumbles over, the reply cannot be read
        return "", ()


def _depth(text: str) -> int:
    """How deep brackets are nested at most; brackets that do not match are counted as they come."""
    depth = deepest = 0
    for character in text:
        if character in "[{(":
            depth += 1
            deepest = max(deepest, depth)
        elif character in ")}]":
            depth -= 1
    return deepest
