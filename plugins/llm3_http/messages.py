"""Anthropic's Messages API."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

from llm3.jsonio import to_builtins
from llm3.types import Completion, FrozenDict, Request, Stats
from llm3_http.dialect import Dialect
from llm3_http.features import Features
from llm3_http.fields import count, mapping, text_of, texts_of
from llm3_http.settings import HttpSettings
from llm3_http.thinking import apart

_CUT_OFF = ("max_tokens", "model_context_window_exceeded")


class Messages(Dialect):
    """``POST /messages``."""

    path = "/messages"
    key_header, key_prefix = "x-api-key", ""
    headers: Mapping[str, str] = FrozenDict({"anthropic-version": "2023-06-01"})

    def payload(self, settings: HttpSettings, features: Features, request: Request) -> dict[str, Any]:
        """The JSON of a request: what the system says stands apart from the messages."""
        system = "\n\n".join(message.content for message in request.messages if message.role == "system")
        payload: dict[str, Any] = {
            "model": settings.model,
            "max_tokens": settings.reply_limit,
            "messages": [
                {"role": message.role, "content": message.content}
                for message in request.messages
                if message.role != "system"
            ],
        }
        if system:
            payload["system"] = system
        if features.temperature:
            payload["temperature"] = settings.temperature
        if features.reply_format == "json_schema":
            form = {"type": "json_schema", "schema": to_builtins(request.schema)}
            payload["output_config"] = {"format": form}
        return payload

    def completion(self, document: Mapping[str, Any], settings: HttpSettings) -> Completion | None:
        """The text blocks, and the thinking blocks apart from them."""
        content = document.get("content")
        if not isinstance(content, list):
            return None
        thought, text = apart(texts_of(content, ("text",)))
        reason = text_of(document, "stop_reason")
        usage = mapping(document.get("usage"))
        cached = count(usage, "cache_read_input_tokens")
        return Completion(
            text=settings.key.redact(text),
            stats=Stats(
                # Unlike OpenAI's, its count of what was read leaves out the cache.
                prompt_tokens=count(usage, "input_tokens") + cached + count(usage, "cache_creation_input_tokens"),
                cached_tokens=cached,
                completion_tokens=count(usage, "output_tokens"),
            ),
            model=settings.clean(text_of(document, "model")),
            finish_reason="length" if reason in _CUT_OFF else settings.clean(reason),
            reasoning=settings.key.redact("\n".join(filter(None, (texts_of(content, ("thinking",)), thought)))),
        )
