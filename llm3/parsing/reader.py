"""Reads one value: JSON, Python literals, and what models make of them, in one grammar.

Strict JSON is read as JSON. Beyond it: single and typographic quotes, comments, trailing commas, line breaks in text,
tuples, text without quotes, and calls such as ``pick(['red_box'], {})``. A stack of open brackets takes the place of
recursion, so no nesting can exhaust the interpreter.
"""

from __future__ import annotations

from dataclasses import dataclass, field

from llm3.parsing import sentences
from llm3.parsing.tokens import Kind, Token, tokens
from llm3.parsing.values import Arguments, Bare, Items, Pairs, Value, is_number

MAX_DEPTH = 50
"""Brackets nested deeper than this are not read."""
_CLOSERS = {"[": "]", "{": "}", "(": ")"}
_JSON_WORDS = ("true", "false", "null")
_PYTHON_WORDS = ("True", "False", "None")


class Unreadable(Exception):  # not an error: it never leaves this package
    """The text is no value."""

    def __init__(self, position: int) -> None:
        self.position = position
        """How far reading came: a measure of what it cost."""


@dataclass(frozen=True)
class Reading:
    """A value, and how it was come by."""

    value: Items | Pairs | Arguments
    end: int
    """The position behind its last bracket."""
    liberties: tuple[str, ...]
    """Where it is not strict JSON, as sentences."""


@dataclass(slots=True)
class _Open:
    """A bracket that is not closed yet; the entry before the next comma has a key, a value, both or neither."""

    bracket: str
    start: int
    call: bool = False
    entries: list[tuple[str | None, Value]] = field(default_factory=list)
    key: str | None = None
    value: Value | None = None
    value_start: int = 0

    def take(self, value: Value, token: Token, start: int) -> None:
        if self.value is not None:
            raise Unreadable(token.end)
        self.value, self.value_start = value, start

    def take_key(self, token: Token) -> None:
        if self.bracket == "[" or self.key is not None or not isinstance(self.value, str | Bare):
            raise Unreadable(token.end)
        self.key = self.value.text if isinstance(self.value, Bare) else self.value
        self.value = None

    def end_entry(self, token: Token) -> None:
        if self.value is None or (self.bracket == "{" and self.key is None):
            raise Unreadable(token.end)
        self.entries.append((self.key, self.value))
        self.key = self.value = None

    def close(self, token: Token, text: str) -> Value:
        source = text[self.start : token.end]
        if self.call:
            return Bare(source)
        if self.bracket == "{":
            return Pairs(tuple((key, value) for key, value in self.entries if key is not None), source)
        if any(key is not None for key, _ in self.entries):
            raise Unreadable(token.end)
        return Items(tuple(value for _, value in self.entries), source)

    def arguments(self) -> Arguments:
        positional = tuple(value for key, value in self.entries if key is None)
        return Arguments(positional, tuple((key, value) for key, value in self.entries if key is not None))


def read(text: str, start: int) -> Reading:
    """Read the value that opens with the bracket at `start`.

    Returns:
        `Items` for ``[``, `Pairs` for ``{`` and `Arguments` for ``(``.

    Raises:
        Unreadable: It is no value, it is not closed, or its brackets are nested too deep.
    """
    stack: list[_Open] = []
    liberties: dict[str, None] = {}
    for token in tokens(text, start):
        if liberty := _liberty(token, text):
            liberties[liberty] = None
        if token.kind is Kind.COMMENT:
            continue
        if token.kind is Kind.UNCLOSED or len(stack) > MAX_DEPTH:
            raise Unreadable(token.end)
        if token.kind is Kind.TEXT:
            stack[-1].take(token.text, token, token.start)
        elif token.kind is Kind.BARE:
            stack[-1].take(Bare(token.text), token, token.start)
        elif token.text in _CLOSERS:
            stack.append(_opened(token, stack))
        elif token.text == ",":
            stack[-1].end_entry(token)
        elif token.text in ":=":
            stack[-1].take_key(token)
        else:
            top = stack.pop()
            if token.text != _CLOSERS[top.bracket]:
                raise Unreadable(token.end)
            if top.value is not None or top.key is not None:
                top.end_entry(token)
            elif top.entries:
                liberties[sentences.TRAILING_COMMA] = None
            if not stack:
                value = top.arguments() if top.bracket == "(" else top.close(token, text)
                assert isinstance(value, Items | Pairs | Arguments)  # noqa: S101  # a call is never outermost
                return Reading(value, token.end, tuple(liberties))
            stack[-1].take(top.close(token, text), token, top.start)
    raise Unreadable(len(text))


def _opened(token: Token, stack: list[_Open]) -> _Open:
    """A bracket opens; a round one behind a bare name makes a call of it."""
    outer = stack[-1] if stack else None
    if outer and token.text == "(" and isinstance(outer.value, Bare):
        outer.value = None
        return _Open("(", outer.value_start, call=True)
    if outer and (outer.value is not None or (outer.bracket == "{" and outer.key is None)):
        raise Unreadable(token.end)
    return _Open(token.text, token.start)


def _liberty(token: Token, text: str) -> str | None:
    """What strict JSON would not have taken here."""
    if token.kind is Kind.COMMENT:
        return sentences.COMMENT
    if token.kind is Kind.TEXT:
        if text[token.start] == "'":
            return sentences.SINGLE_QUOTES
        if text[token.start] != '"':
            return sentences.TYPOGRAPHIC_QUOTES
        return sentences.LINE_BREAK if "\n" in text[token.start : token.end] else None
    if token.kind is Kind.BARE and token.text not in _JSON_WORDS and not is_number(token.text):
        return sentences.PYTHON_LITERAL if token.text in _PYTHON_WORDS else sentences.NO_QUOTES
    return None
