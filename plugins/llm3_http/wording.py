"""Foreign text and figures made fit for a sentence."""

from __future__ import annotations

import unicodedata

LONGEST = 200
"""Characters of foreign text that a sentence may quote."""


def one_line(text: str) -> str:
    """The text in one line, without control and other invisible characters, single-spaced."""
    return " ".join("".join(c for c in text if c.isspace() or unicodedata.category(c)[0] != "C").split())


def cut(text: str) -> str:
    """The beginning of the text, at most `LONGEST` characters."""
    return text if len(text) <= LONGEST else f"{text[: LONGEST - 1]}…"


def quoted(message: str) -> str:
    """What the server says, as the end of a sentence; nothing if it says nothing."""
    return f"; it says: {message}" if message else ""


def seconds(duration: float) -> str:
    """A duration in seconds, with its unit, such as ``0.5 s``."""
    return f"{duration:.1f}".removesuffix(".0") + " s"
