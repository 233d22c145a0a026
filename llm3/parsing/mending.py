"""What is tried with a reply that cannot be read as it is."""

from __future__ import annotations

import json
import re
from collections.abc import Iterator

from json_repair import repair_json

from llm3.parsing import sentences

# json-repair takes time that grows with the square of the marks in a text and worse, and calls itself for nested
# brackets. Within these limits the worst text known takes a fraction of a second.
MAX_CHARACTERS = 8_000
MAX_MARKS = 600
MAX_DEPTH = 20
MAX_MISMATCHES = 10

_ANSWER = re.compile(r"\{[ \t\r\n]{0,80}[\"'“”‘’]?(?:reasoning|full[ _-]?plan|plan|actions)\b", re.IGNORECASE)
_MARK = re.compile(r"[\[\]{}()\"'“”‘’]")
_CLOSERS = {"[": "]", "{": "}", "(": ")"}
_CALL_OPENS = re.compile(r"\"(?=[A-Za-z_][\w.-]{0,80}\()")
_CALL_CLOSES = re.compile(r"\)\"")


def mended(text: str) -> Iterator[tuple[str, tuple[str, ...]]]:
    """Ways to read the text's last, damaged answer: other texts, each with what was done to it as sentences.

    They are read and checked like any other: json-repair makes text of whatever it cannot read, such as ``3.14/2``.
    """
    damaged = _damaged_answer(text)
    if damaged:
        yield _without_quotes_around_calls(damaged), (sentences.UNESCAPED_QUOTES,)
    if damaged and _is_repairable(damaged):
        yield _repaired(damaged)


def _damaged_answer(text: str) -> str:
    """From where an answer seems to begin, to the end or to the fence around it."""
    start = max((match.start() for match in _ANSWER.finditer(text)), default=len(text))
    damaged = text[start:].partition("```")[0]
    return damaged if len(damaged) <= MAX_CHARACTERS else ""


def _without_quotes_around_calls(text: str) -> str:
    """The text with ``"pick(["red_box"], {})"`` made ``pick(["red_box"], {})``.

    Quotes inside quotes without an escape are common damage, and the outer pair is the one that is not needed.
    """
    return _CALL_CLOSES.sub(")", _CALL_OPENS.sub("", text))


def _is_repairable(text: str) -> bool:
    marks = _MARK.findall(text)
    closers: list[str] = []
    mismatches = 0
    for mark in marks:
        if mark in _CLOSERS:
            closers.append(_CLOSERS[mark])
        elif closers and mark == closers[-1]:
            closers.pop()
        elif mark in _CLOSERS.values():
            mismatches += 1
        if len(closers) > MAX_DEPTH or mismatches > MAX_MISMATCHES:
            return False
    return len(marks) <= MAX_MARKS


def _repaired(text: str) -> tuple[str, tuple[str, ...]]:
    try:
        value, log = repair_json(text, skip_json_loads=True, logging=True)
        steps = dict.fromkeys(entry["text"] for entry in log)
        return json.dumps(value, ensure_ascii=False), tuple(f"json-repair: {step}" for step in steps)
    except Exception:
        return "", ()  # whatever a library stumbles over in damaged text: the reply cannot be read
