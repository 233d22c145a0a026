"""What a request makes use of, and what is given up when a server refuses it."""

from __future__ import annotations

import re
from dataclasses import dataclass, replace

from llm3_http.presets import LimitField, Preset, ReplyFormat

_REFUSALS = (400, 422)
_FORMAT = re.compile(
    r"response.?format|output.?(config|format)|schema|json.?(object|mode)|grammar|structured|guided|regex|\bpattern\b"
)
_NOT_TAKEN = re.compile(
    r"unsupported|not (yet )?support|n't support|deprecated|not permitted|unknown|unrecogni[sz]ed|unexpected|"
    r"not (allowed|available|accepted|recogni[sz]ed)|extra (inputs|fields)|only the default|cannot be (used|set)"
)
"""How servers word that they do not take a field at all. A value that is wrong is the user's to set right."""
CONTEXT = re.compile(
    r"context[ _](length|window|size)|prompt is too long|(input|prompt) token.*exceed|too many (input )?tokens",
    re.IGNORECASE,
)
"""How servers word that a prompt does not fit. Such a sentence may name any field, and is about none."""


@dataclass(frozen=True)
class Features:
    """What a request makes use of. The first of each tuple is in use, the others are what is left to try."""

    reply_formats: tuple[ReplyFormat, ...]
    limit_fields: tuple[LimitField, ...]
    limit: bool
    """Whether the length of the reply is limited at all."""
    temperature: bool
    """Whether a temperature is sent."""
    structured: bool = True
    """Whether the reply has a form to ask for; without one, no format is."""

    @property
    def reply_format(self) -> ReplyFormat:
        """What is asked for."""
        return self.reply_formats[0] if self.structured else "text"


def features_of(preset: Preset, *, limit: bool, temperature: bool) -> Features:
    """All that a server is thought to take.

    Args:
        preset: The server.
        limit: Whether the length of a reply is to be limited.
        temperature: Whether a temperature is to be sent.
    """
    other: LimitField = "max_tokens" if preset.limit_field == "max_completion_tokens" else "max_completion_tokens"
    fields = (preset.limit_field, other) if preset.dialect == "chat" else (preset.limit_field,)
    return Features(preset.reply_formats, fields, limit, temperature)


def fewer_features(features: Features, status: int, message: str) -> Features | None:
    """What to ask for instead of what a server refused; None if the refusal is about something else.

    Args:
        features: What the request made use of.
        status: The status of the answer.
        message: What the server says.
    """
    said = message.lower()
    if status not in _REFUSALS or CONTEXT.search(said):
        return None
    not_taken = _NOT_TAKEN.search(said)
    if features.temperature and "temperature" in said and not_taken:
        return replace(features, temperature=False)
    used, *others = features.limit_fields
    if features.limit and others and re.search(rf"\b{used}\b", said) and not_taken:
        return replace(features, limit_fields=tuple(others))
    _, *left = features.reply_formats
    if left and features.reply_format != "text" and _FORMAT.search(said):
        return replace(features, reply_formats=tuple(left))
    return None


def difference(before: Features, after: Features) -> str:
    """What was given up, for a note."""
    if before.temperature != after.temperature:
        return "the temperature is refused, and left out from now on"
    if before.limit_fields != after.limit_fields:
        return f"{before.limit_fields[0]} is refused, and {after.limit_fields[0]} is sent from now on"
    return (
        f"the reply format {before.reply_formats[0]} is refused, and {after.reply_formats[0]} is asked for from now on"
    )
