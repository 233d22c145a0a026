"""A key that does not show itself."""

from __future__ import annotations

import re
from html.entities import html5

from llm3.errors import UsageError

MASK = "***"
_PLACEHOLDER = 8
"""Shorter keys are words such as ``EMPTY`` or ``ollama``, which local servers ask for; texts may well contain them."""


def _spellings(character: str) -> str:
    """A pattern for a character as it is, and as JSON, Python, addresses and HTML escape it."""
    code = f"{ord(character):02x}"
    entities = [re.escape(f"&{name};") for name, value in html5.items() if value == character and name[-1] != ";"]
    named = "".join(f"|{entity}" for entity in entities)
    return (
        rf"(?:\\*{re.escape(character)}|\\+(?i:u00{code}|x{code}|U000000{code})|(?i:%(?:25)*{code})"
        rf"|(?i:&#0*{ord(character)};|&#x0*{code};){named})"
    )


class Secret:
    """A text that prints as ``***``; an empty one is no secret and is false.

    It is not a dataclass, since ``dataclasses.asdict`` would spell out its field.
    """

    __slots__ = ("_value",)

    def __init__(self, value: str = "", variable: str = "LLM3_API_KEY") -> None:
        """Keep the value.

        Args:
            value: The key; space around it is dropped.
            variable: Where it comes from, for the error.

        Raises:
            UsageError: It cannot be sent in an HTTP header. HTTP libraries quote such a header in their errors.
        """
        value = value.strip()
        if not (value.isascii() and value.isprintable()) or " " in value:
            raise UsageError(
                f"{variable} holds a space or a character that is not printable ASCII: set it to the key alone"
            )
        self._value = value

    def reveal(self) -> str:
        """The value itself."""
        return self._value

    def redact(self, text: str) -> str:
        """The text with ``***`` in place of the value, also where some of its characters are written as escapes.

        Values of under eight characters are placeholders and stay.
        """
        if len(self._value) < _PLACEHOLDER:
            return text
        return re.sub("".join(map(_spellings, self._value)), MASK, text)

    def __bool__(self) -> bool:
        return bool(self._value)

    def __repr__(self) -> str:
        return MASK
