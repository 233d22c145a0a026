"""What ``llm3 doctor`` asks, and what it makes of the answer."""

from __future__ import annotations

import json

from llm3.parsing import reply_schema
from llm3.types import Completion, Context, Message, Request
from llm3_http.context_window import LONG
from llm3_http.features import Features
from llm3_http.settings import HttpSettings

_ASKED = 'Answer with this JSON object and nothing else: {"Reasoning": "", "Full Plan": []}'


def question(settings: HttpSettings) -> Request:
    """A tiny question; a long one for a server that cuts long ones off in silence, which nothing else would show."""
    filling = "Do not read this line: " + "box " * LONG + "\n\n" if settings.preset.cuts_long_prompts else ""
    return Request((Message("user", filling + _ASKED),), Context("", (), (), ()), schema=reply_schema((), ()))


def verdict(answer: Completion, features: Features, settings: HttpSettings) -> str:
    """One line: who answered, in which format, and what it took.

    Args:
        answer: To the question.
        features: What the server has not refused.
        settings: Who was asked.
    """
    stats = answer.stats
    words = [
        f"{answer.model or settings.clean(settings.model)} answers at {settings.base_url}: {_format(answer, features)}",
        f"{stats.prompt_tokens} tokens read, {stats.completion_tokens} written",
    ]
    if answer.cut_off:
        words.append("the reply was cut off at its limit, so give a larger --max-reply-tokens")
    return "; ".join([*words, *answer.notes])


def _format(answer: Completion, features: Features) -> str:
    asked = features.reply_format
    if asked == "text":
        return "no JSON mode, so replies are plain text"
    try:
        kept = isinstance(json.loads(answer.text), dict)
    except (ValueError, RecursionError):
        kept = False
    return f"reply format {asked}" if kept else f"reply format {asked}, which it takes but does not keep to"
