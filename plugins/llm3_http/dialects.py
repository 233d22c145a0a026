"""The dialects by name."""

from __future__ import annotations

from llm3_http.chat import ChatCompletions
from llm3_http.dialect import Dialect
from llm3_http.messages import Messages
from llm3_http.presets import Preset


def dialect_of(preset: Preset) -> Dialect:
    """How this server is spoken to."""
    return Messages() if preset.dialect == "messages" else ChatCompletions()
