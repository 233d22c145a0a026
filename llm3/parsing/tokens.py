"""Cuts text into tokens, each position visited once: every pattern here matches without backtracking."""

from __future__ import annotations

import re
from collections.abc import Iterator
from enum import Enum
from typing import NamedTuple

# A word ends at a space, a bracket, a quote or a separator. Words on one line form one token, so that
# `3.14 / 2` stays in one piece; a comment ends it.
_WORD = r"[^\s\[\]{}(),:=\"'“”„‘’‚]+"
_TOKEN = re.compile(
    rf"""(?P<space>\s+)
       | (?P<comment>//[^\n]*|\#[^\n]*|/\*(?:[^*]|\*(?!/))*(?:\*/)?)
       | (?P<quote>["'“”„‘’‚])
       | (?P<mark>[\[\]{{}}(),:=])
       | (?P<bare>{_WORD}(?:[ \t]+(?!//|/\*|\#){_WORD})*)""",
    re.VERBOSE,
)
_CLOSERS = {'"': '"', "'": "'", "“": "“”", "”": "“”", "„": "“”", "‘": "‘’", "’": "‘’", "‚": "‘’"}
_BODIES = {
    opener: re.compile(rf"[^\\{closers}]*(?:\\.[^\\{closers}]*)*", re.DOTALL) for opener, closers in _CLOSERS.items()
}
_ESCAPE = re.compile(
    r"""\\(?:u(?P<pair>[dD][89abAB][0-9a-fA-F]{2}\\u[dD][c-fC-F][0-9a-fA-F]{2})
         | (?P<code>u[0-9a-fA-F]{4}|U[0-9a-fA-F]{8}|x[0-9a-fA-F]{2})
         | (?P<letter>.))""",
    re.VERBOSE | re.DOTALL,
)
_LETTERS = {"n": "\n", "t": "\t", "r": "\r", "b": "\b", "f": "\f", "v": "\v", "a": "\a"}


class Kind(Enum):
    """What a token is."""

    TEXT = "text in quotes, escapes resolved"
    BARE = "text without quotes"
    MARK = "a bracket or a separator"
    COMMENT = "a comment"
    UNCLOSED = "a quote that is never closed"


class Token(NamedTuple):
    """A piece of text, and where it stands in the whole."""

    kind: Kind
    text: str
    start: int
    end: int


def tokens(text: str, start: int) -> Iterator[Token]:
    """The tokens from `start` on, to the end of the text; spaces are left out."""
    while match := _TOKEN.match(text, start):
        end = match.end()
        if match.lastgroup == "quote":
            token = _quoted(text, start)
            end = token.end
            yield token
        elif match.lastgroup == "mark":
            yield Token(Kind.MARK, match[0], start, end)
        elif match.lastgroup == "bare":
            yield Token(Kind.BARE, match[0], start, end)
        elif match.lastgroup == "comment":
            yield Token(Kind.COMMENT, match[0], start, end)
        start = end


def _quoted(text: str, start: int) -> Token:
    body = _BODIES[text[start]].match(text, start + 1)
    end = body.end() if body else start + 1
    if body is None or not text.startswith(tuple(_CLOSERS[text[start]]), end):
        return Token(Kind.UNCLOSED, "", start, len(text))
    return Token(Kind.TEXT, _ESCAPE.sub(_unescaped, body[0]), start, end + 1)


def _unescaped(match: re.Match[str]) -> str:
    r"""What an escape of JSON or Python stands for; an unknown one, such as ``\_``, stands for its letter."""
    if pair := match["pair"]:
        high, low = int(pair[:4], 16), int(pair[6:], 16)
        return chr(0x10000 + ((high - 0xD800) << 10) + (low - 0xDC00))
    if code := match["code"]:
        point = int(code[1:], 16)
        # Half a surrogate pair is no character, and no file or server would take it.
        return chr(point) if point <= 0x10FFFF and not 0xD800 <= point <= 0xDFFF else "\N{REPLACEMENT CHARACTER}"
    return _LETTERS.get(match["letter"], match["letter"])
