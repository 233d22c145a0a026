"""Reading what a server sends: the answer, or why there is none."""

from __future__ import annotations

import json
from typing import Any

from llm3.errors import BackendError
from llm3.types import Completion
from llm3_http.dialect import Dialect
from llm3_http.fields import mapping, text_of
from llm3_http.retry import TryAgain, may_pass
from llm3_http.settings import HttpSettings
from llm3_http.wording import quoted

_MESSAGE_KEYS = ("error", "message", "detail", "msg")


def read_completion(body: bytes, settings: HttpSettings, dialect: Dialect) -> Completion:
    """The answer in a body of a successful reply.

    A model that says nothing, or declines, has answered: its text is empty, or the refusal (with the finish reason
    ``"refusal"``).

    Raises:
        TryAgain: It broke off, or holds an error that may pass.
        BackendError: It holds no answer.
    """
    document = _parsed(body)
    if document is None and body.lstrip().startswith(b"{") and not body.rstrip().endswith(b"}"):
        raise TryAgain(
            f"the server at {settings.base_url} broke off its answer: try again later, or look into the server's log",
            "the answer broke off",
        )
    if document is None:
        raise _refused("sent no JSON object: check LLM3_BASE_URL", body, settings)
    if document.get("error"):
        raise _reported(body, settings, mapping(document["error"]).get("code"))
    completion = dialect.completion(document, settings)
    if completion is None:
        raise _refused(f"sent no answer of {dialect.path}: check LLM3_BASE_URL", body, settings)
    return completion


def _reported(body: bytes, settings: HttpSettings, code: object) -> Exception:
    """An error in a body whose status says success, as OpenRouter sends it; its code may be a status that passes."""
    refused = _refused("reports an error: check --model", body, settings)
    return TryAgain(str(refused), f"error {code}") if isinstance(code, int) and may_pass(code) else refused


def server_message(body: bytes) -> str:
    """What a server says of itself: the message in the JSON forms that are in use, or else the body as it is."""
    try:
        found: Any = json.loads(body)
    except (ValueError, RecursionError):
        found = ""
    # OpenRouter's own words are empty ones; beside them it quotes the server behind it.
    behind = text_of(mapping(mapping(mapping(found).get("error")).get("metadata")), "raw")
    while not isinstance(found, str):
        if isinstance(found, dict):
            found = next((found[key] for key in _MESSAGE_KEYS if found.get(key)), "")
        else:
            found = found[0] if isinstance(found, list) and found else ""
    return f"{found} {behind}".strip() or body.decode("utf-8", "replace")


def _refused(problem: str, body: bytes, settings: HttpSettings) -> BackendError:
    says = quoted(settings.clean(server_message(body)))
    return BackendError(f"the server at {settings.base_url} {problem}{says}")


def _parsed(body: bytes) -> dict[str, Any] | None:
    try:
        document = json.loads(body)
    except (ValueError, RecursionError):  # also: bytes that are no text, numbers of thousands of digits
        return None
    return document if isinstance(document, dict) else None
