"""What a status other than success means."""

from __future__ import annotations

import re

from llm3.errors import BackendError
from llm3_http.address import masked
from llm3_http.features import CONTEXT
from llm3_http.reply import server_message
from llm3_http.retry import TryAgain, may_pass, read_retry_after
from llm3_http.settings import HttpSettings
from llm3_http.transport import Reply
from llm3_http.wording import quoted


def check_status(reply: Reply, settings: HttpSettings, *, attempt: int, now: float) -> None:
    """Let a success pass.

    Args:
        reply: What the server sent.
        settings: For the sentences.
        attempt: Which attempt this was, counted from 1.
        now: Seconds since the epoch, by the wall clock; Retry-After may hold a date.

    Raises:
        TryAgain: The server is busy or out of order.
        BackendError: The server refuses, and would refuse again.
    """
    status = reply.status
    if 200 <= status < 300:
        return
    message = settings.clean(server_message(reply.body))
    says = quoted(message)
    server = f"the server at {settings.base_url}"
    if may_pass(status):
        tries = "1 try" if attempt == 1 else f"{attempt} tries"
        raise TryAgain(
            f"{server} answers {status} after {tries}: try again later, or give another --model{says}",
            f"status {status}",
            read_retry_after(reply.headers.get("Retry-After"), now),
        )
    if 300 <= status < 400:
        target = settings.clean(masked(reply.headers.get("Location", ""))) or "nowhere"
        raise BackendError(
            f"{server} redirects to {target} ({status}), which is not followed, as the key would go with it: "
            "set LLM3_BASE_URL to the right address"
        )
    # Gemini calls a wrong key a bad request.
    if status in (401, 403) or (status == 400 and re.search("api.?key", message, re.IGNORECASE)):
        verb = "refuses the key" if settings.key else "asks for a key"
        raise BackendError(f"{server} {verb} ({status}): set {settings.key_variables}{says}")
    if status == 404:
        raise BackendError(
            f"{server} has no model {settings.clean(settings.model)!r}, or is no such API (404): "
            f"give another --model, or set LLM3_BASE_URL{says}"
        )
    if status in (400, 413, 422) and CONTEXT.search(message):
        raise BackendError(
            f"the prompt does not fit into the context of model {settings.clean(settings.model)!r} at "
            f"{settings.base_url} ({status}): give a smaller --trace-size or another --model, "
            f"or let the server have a larger context{says}"
        )
    raise BackendError(f"{server} refuses the request ({status}): check --model and --temperature{says}")
