"""The backend ``http``."""

from __future__ import annotations

import time
from collections.abc import Callable, Iterable
from dataclasses import replace
from typing import Any

import numpy as np
import requests

from llm3.errors import BackendError
from llm3.interfaces import LLMBackend
from llm3.types import Completion, Message, Request
from llm3_http.address import is_openai
from llm3_http.reply import read_completion
from llm3_http.retry import persist
from llm3_http.settings import HttpSettings
from llm3_http.statuses import check_status
from llm3_http.transport import exchange


class HttpBackend(LLMBackend):
    """A model behind an OpenAI-compatible ``/chat/completions``.

    Whatever ends without an answer is a BackendError whose one line says what to set. The key is in none of them,
    nor in any answer or repr.
    """

    def __init__(
        self,
        settings: HttpSettings,
        *,
        rng: np.random.Generator,
        session_factory: Callable[[], requests.Session] = requests.Session,
        sleep: Callable[[float], None] = time.sleep,
        clock: Callable[[], float] = time.monotonic,
        wall_clock: Callable[[], float] = time.time,
    ) -> None:
        """Make a backend; nothing is sent yet.

        Args:
            settings: Server, model and limits.
            rng: For the jitter of the waits between retries.
            session_factory: Makes the session that keeps the connections.
            sleep: Waits for a number of seconds.
            clock: Monotonic seconds, for deadlines.
            wall_clock: Seconds since the epoch, for a Retry-After that is a date.

        Raises:
            BackendError: OpenAI is to be asked, and there is no key: better said before a run begins.
        """
        if is_openai(settings.base_url) and not settings.key:
            raise BackendError(
                f"{settings.base_url} needs a key: set {settings.key_variables}, or LLM3_BASE_URL for another server"
            )
        self._settings, self._rng = settings, rng
        self._session = session_factory()
        self._sleep, self._clock, self._wall_clock = sleep, clock, wall_clock

    def complete(self, request: Request) -> Completion:
        """Send the messages and read the model's answer, again where the failure may pass."""
        settings = self._settings
        payload = chat_payload(settings, request.messages)
        until = self._clock() + settings.deadline

        def ask(attempt: int) -> Completion:
            reply = exchange(self._session, settings, payload, until=until, clock=self._clock)
            check_status(reply, settings, attempt=attempt, now=self._wall_clock())
            completion = read_completion(reply.body, settings)
            return replace(completion, stats=replace(completion.stats, retries=attempt - 1))

        return persist(ask, settings, until=until, rng=self._rng, sleep=self._sleep, clock=self._clock)

    def close(self) -> None:
        """Close the connections that are kept open."""
        self._session.close()

    def __repr__(self) -> str:
        return f"HttpBackend({self._settings!r})"


def chat_payload(settings: HttpSettings, messages: Iterable[Message]) -> dict[str, Any]:
    """The JSON of a request."""
    payload: dict[str, Any] = {
        "model": settings.model,
        "messages": [{"role": message.role, "content": message.content} for message in messages],
    }
    if settings.temperature is not None:
        payload["temperature"] = settings.temperature
    return payload
