"""OpenAI's chat completions, which many others speak, too."""

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


class ChatCompletions(Dialect):
    """``POST /chat/completions``."""

    path = "/chat/completions"
    key_header, key_prefix = "Authorization", "Bearer "
    headers: Mapping[str, str] = FrozenDict()

    def payload(self, settings: HttpSettings, features: Features, request: Request) -> dict[str, Any]:
        """The JSON of a request."""
        payload: dict[str, Any] = {
            "model": settings.model,
            "messages": [{"role": message.role, "content": message.content} for message in request.messages],
        }
        if features.temperature:
            payload["temperature"] = settings.temperature
        if features.limit:
            payload[features.limit_fields[0]] = settings.reply_limit
        if features.reply_format == "json_schema":
            form = {"name": "reply", "strict": True, "schema": to_builtins(request.schema)}
            payload["response_format"] = {"type": "json_schema", "json_schema": form}
        elif features.reply_format == "json_object":
            payload["response_format"] = {"type": "json_object"}
        return payload

    def completion(self, document: Mapping[str, Any], settings: HttpSettings) -> Completion | None:
        """The first choice. A model that declines has answered: its text is the refusal, and so is the reason."""
        choices = document.get("choices")
        choice = mapping(choices[0]) if isinstance(choices, list) and choices else {}
        message = choice.get("message")
        if not isinstance(message, dict):
            return None
        content = message.get("content")
        thought, text = apart(content if isinstance(content, str) else texts_of(content, ("text", "output_text")))
        reasoning = text_of(message, "reasoning_content") or text_of(message, "reasoning")
        reasoning = reasoning or texts_of(content, ("thinking", "reasoning"))
        reason = text_of(choice, "finish_reason")
        if not text and text_of(message, "refusal"):
            text, reason = text_of(message, "refusal"), "refusal"
        return Completion(
            text=settings.key.redact(text),
            stats=_spent(mapping(document.get("usage"))),
            model=settings.clean(text_of(document, "model")),
            finish_reason=settings.clean(reason),
            reasoning=settings.key.redact("\n".join(filter(None, (reasoning, thought)))),
        )


def _spent(usage: Mapping[str, Any]) -> Stats:
    read, written = count(usage, "prompt_tokens"), count(usage, "completion_tokens")
    # Gemini leaves what it thought out of completion_tokens, but not out of the total.
    written = max(written, count(usage, "total_tokens") - read)
    return Stats(
        prompt_tokens=read,
        cached_tokens=min(read, count(mapping(usage.get("prompt_tokens_details")), "cached_tokens")),
        completion_tokens=written,
        reasoning_tokens=min(written, count(mapping(usage.get("completion_tokens_details")), "reasoning_tokens")),
    )
