"""OpenAI's chat completions, as a server reads and writes them."""

from __future__ import annotations

from collections.abc import Collection, Mapping
from typing import Any

from llm3.types import Completion, Message

Payload = Mapping[str, Any]
"""A request's JSON."""
_CHARACTERS = 4
"""Characters that count as a token."""


def messages_of(payload: object) -> tuple[Message, ...]:
    """The messages of a request.

    Raises:
        ValueError: It is no request for a chat completion.
    """
    if not isinstance(payload, Mapping):
        raise ValueError("the request must be a JSON object")
    messages = payload.get("messages")
    if not isinstance(payload.get("model"), str):
        raise ValueError("the request must name a 'model'")
    if payload.get("stream"):
        raise ValueError("'stream' is not supported here")
    if not isinstance(messages, list) or not messages:
        raise ValueError("the request must have a list of 'messages'")
    for message in messages:
        if not isinstance(message, Mapping) or not all(isinstance(message.get(k), str) for k in ("role", "content")):
            raise ValueError("each of the 'messages' must have a 'role' and a 'content', both texts")
    return tuple(Message(message["role"], message["content"]) for message in messages)


def refused(payload: Payload, refuses: Collection[str]) -> str | None:
    """The field of the request that is refused, or None.

    Args:
        payload: The request.
        refuses: Names of fields, such as ``"temperature"``, and types of `response_format`, such as ``"json_schema"``.
    """
    response_format = payload.get("response_format")
    if isinstance(response_format, Mapping) and response_format.get("type") in refuses:
        return "response_format"
    return next((name for name in payload if name in refuses), None)


def refusal(payload: Payload, field: str) -> str:
    """The sentence in which a server refuses a field."""
    of_type = f" of type {payload[field].get('type')!r}" if isinstance(payload[field], Mapping) else ""
    return f"Invalid parameter: '{field}'{of_type} is not supported with this model."


def chat_completion(completion: Completion, payload: Payload) -> dict[str, Any]:
    """The body of an answer. Tokens that the completion does not count are estimated from its length."""
    declined = completion.finish_reason == "refusal"
    text, stats = completion.text, completion.stats
    message: dict[str, Any] = {"role": "assistant", "content": None if declined else text}
    if declined:
        message["refusal"] = text
    if completion.reasoning:
        message["reasoning_content"] = completion.reasoning
    read = stats.prompt_tokens or sum(len(m["content"]) for m in payload["messages"]) // _CHARACTERS
    wrote = stats.completion_tokens or (len(text) + len(completion.reasoning)) // _CHARACTERS
    return {
        "id": "chatcmpl-1",
        "object": "chat.completion",
        "created": 0,
        "model": completion.model or payload["model"],
        "choices": [
            {
                "index": 0,
                "message": message,
                "finish_reason": "stop" if declined else completion.finish_reason or "stop",
            }
        ],
        "usage": {
            "prompt_tokens": read,
            "completion_tokens": wrote,
            "total_tokens": read + wrote,
            "prompt_tokens_details": {"cached_tokens": stats.cached_tokens},
            "completion_tokens_details": {"reasoning_tokens": stats.reasoning_tokens},
        },
    }
