"""Reading what a server sends: the answer, or why there is none."""

from __future__ import annotations

import json
from typing import Any

from llm3.errors import BackendError
from llm3.types import Completion, Stats
from llm3_http.settings import HttpSettings
from llm3_http.wording import quoted

_MESSAGE_KEYS = ("error", "message", "detail", "msg")


def read_completion(body: bytes, settings: HttpSettings) -> Completion:
    """The answer in a body of a successful reply.

    A model that says nothing, or declines, has answered: its text is empty, or the refusal (with the finish reason
    ``"refusal"``). What a model thought on the way is left out.

    Raises:
        BackendError: The body is no chat completion.
    """
    document = _parsed(body)
    if document is None:
        raise _refused("sent no JSON object: check LLM3_BASE_URL", body, settings)
    if document.get("error"):
        raise _refused("reports an error: check --model", body, settings)
    choice = _first(document.get("choices"))
    message = choice.get("message")
    if not isinstance(message, dict):
        raise _refused("sent no choices with a message: check LLM3_BASE_URL", body, settings)
    text, finish_reason = _content(message.get("content")), choice.get("finish_reason")
    refusal = message.get("refusal")
    if not text and isinstance(refusal, str) and refusal:
        text, finish_reason = refusal, "refusal"
    usage = document.get("usage")
    usage = usage if isinstance(usage, dict) else {}
    return Completion(
        text=settings.key.redact(_encodable(without_reasoning(text))),
        stats=Stats(
            prompt_tokens=_count(usage.get("prompt_tokens")),
            completion_tokens=_count(usage.get("completion_tokens")),
        ),
        model=_label(document.get("model"), settings),
        finish_reason=_label(finish_reason, settings),
    )


def server_message(body: bytes) -> str:
    """What a server says of itself: the message in the JSON forms that are in use, or else the body as it is."""
    try:
        found: Any = json.loads(body)
    except (ValueError, RecursionError):
        found = ""
    while not isinstance(found, str):
        if isinstance(found, dict):
            found = next((found[key] for key in _MESSAGE_KEYS if found.get(key)), "")
        else:
            found = found[0] if isinstance(found, list) and found else ""
    return found or body.decode("utf-8", "replace")


def without_reasoning(text: str) -> str:
    """The text without a ``<think>…</think>`` block at its beginning.

    Chat templates that put the opening tag into the prompt leave only the closing one; a reply that ends while the
    model still thinks has no answer.
    """
    thought, closing, answer = text.partition("</think>")
    if thought.lstrip().startswith("<think>"):
        return answer.lstrip()
    return answer.lstrip() if closing and "<think>" not in thought else text


def _refused(problem: str, body: bytes, settings: HttpSettings) -> BackendError:
    says = quoted(settings.clean(server_message(body)))
    return BackendError(f"the server at {settings.base_url} {problem}{says}")


def _parsed(body: bytes) -> dict[str, Any] | None:
    try:
        document = json.loads(body)
    except (ValueError, RecursionError):  # also: bytes that are no text, numbers of thousands of digits
        return None
    return document if isinstance(document, dict) else None


def _first(choices: object) -> dict[str, Any]:
    return choices[0] if isinstance(choices, list) and choices and isinstance(choices[0], dict) else {}


def _content(content: object) -> str:
    """The text of a message's content: a string, or a list of parts of which some are text."""
    if isinstance(content, list):
        parts = (
            part.get("text")
            for part in content
            if isinstance(part, dict) and part.get("type", "text") in ("text", "output_text")
        )
        return "".join(part for part in parts if isinstance(part, str))
    return content if isinstance(content, str) else ""


def _encodable(text: str) -> str:
    """JSON can spell half of a surrogate pair, which no file takes."""
    return text.encode("utf-8", "replace").decode("utf-8")


def _count(value: object) -> int:
    return value if isinstance(value, int) and not isinstance(value, bool) and value >= 0 else 0


def _label(value: object, settings: HttpSettings) -> str:
    return settings.clean(value) if isinstance(value, str) else ""
