"""Where two prompts part, in words."""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from difflib import SequenceMatcher
from itertools import zip_longest

from llm3.records import Exchange
from llm3.types import Message

BEFORE, LONGEST = 30, 80
"""How many characters of a line are shown: before it parts from the other, and at most."""
Line = tuple[str, int, str]
"""A message's role, the number of one of its lines counted from 1, and the line."""


def nearest(messages: Sequence[Message], exchanges: Iterable[Exchange]) -> Exchange | None:
    """The exchange whose prompt has most in common with this one, the first of equals; None if there is none."""
    sent = _lines(messages)

    def likeness(exchange: Exchange) -> float:
        return SequenceMatcher(None, _lines(exchange.request.messages), sent, autojunk=False).ratio()

    return max(exchanges, key=likeness, default=None)


def first_difference(recorded: Sequence[Message], sent: Sequence[Message]) -> str:
    """The first line in which two prompts differ; empty if there is none."""
    nothing = ("", 0, "")
    for there, here in zip_longest(_lines(recorded), _lines(sent), fillvalue=nothing):
        if there[:2] == here[:2] and there != here:
            role, number, _ = there
            return f"line {number} of the {role} message is {_shown(there, here)} there and {_shown(here, there)} here"
        if there != here:  # one of the messages has ended
            line, side = (there, "there") if there[1] >= here[1] else (here, "here")
            return f"line {line[1]} of the {line[0]} message stands {side} only: {_shown(line, nothing)}"
    return ""


def _lines(messages: Iterable[Message]) -> list[Line]:
    return [
        (message.role, number, line)
        for message in messages
        for number, line in enumerate(message.content.split("\n"), start=1)
    ]


def _shown(line: Line, other: Line) -> str:
    """The line, cut to a readable length around where it parts from the other."""
    text, begin = line[2], 0
    if len(text) > LONGEST:
        common = next((at for at, (a, b) in enumerate(zip_longest(text, other[2])) if a != b), 0)
        begin = max(0, common - BEFORE)
    end = begin + LONGEST
    return repr("…" * (begin > 0) + text[begin:end] + "…" * (end < len(text)))
