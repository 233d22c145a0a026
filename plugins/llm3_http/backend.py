"""The backend ``http``."""

from __future__ import annotations

import time
from collections.abc import Callable
from dataclasses import replace

import numpy as np
import requests

from llm3.errors import BackendError
from llm3.interfaces import LLMBackend
from llm3.types import Completion, Request
from llm3_http.call import Call
from llm3_http.dialects import dialect_of
from llm3_http.examination import question, verdict
from llm3_http.features import features_of
from llm3_http.retry import persist
from llm3_http.settings import HttpSettings
from llm3_http.watchdog import watched

EXAMINED = 60.0
"""Seconds that an examination waits for its answer."""


class HttpBackend(LLMBackend):
    """A model behind an HTTP server.

    Whatever ends without an answer is a BackendError whose one line says what to set. The key is in none of them,
    nor in any answer or repr. What the server refused once, such as a reply format, is not asked for again.
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
            BackendError: The server needs a key, and there is none: better said before a run begins.
        """
        if settings.preset.needs_key and not settings.key:
            raise BackendError(
                f"{settings.base_url} needs a key: set {settings.key_variables}, or LLM3_BASE_URL for another server"
            )
        self._settings, self._rng = settings, rng
        self._dialect = dialect_of(settings.preset)
        self._session = session_factory()
        self._watchdog = watched(self._session)
        self._sleep, self._clock, self._wall_clock = sleep, clock, wall_clock
        self._features = features_of(
            settings.preset, limit=settings.reply_limit is not None, temperature=settings.temperature is not None
        )

    def complete(self, request: Request) -> Completion:
        """Send the messages and read the model's answer, again where the failure may pass."""
        return self._answer(request, self._settings)

    def examine(self) -> str:
        """Make one call, as small as the server's ways allow and without retries, and say how it went."""
        settings = replace(self._settings, max_attempts=1, read_timeout=min(EXAMINED, self._settings.read_timeout))
        answer = self._answer(question(settings), settings)
        return verdict(answer, self._features, settings)

    def _answer(self, request: Request, settings: HttpSettings) -> Completion:
        until = self._clock() + min(settings.deadline, request.seconds)
        features = replace(self._features, structured=bool(request.schema))
        call = Call(self._session, self._watchdog, settings, self._dialect, request, features)
        try:
            completion = persist(
                lambda attempt: call.ask(attempt, until=until, clock=self._clock, wall_clock=self._wall_clock),
                settings,
                until=until,
                note=call.note,
                rng=self._rng,
                sleep=self._sleep,
                clock=self._clock,
            )
        except BackendError as error:
            in_vain = call.requests - call.step_downs
            raise BackendError(
                str(error),
                retries=in_vain,
                step_downs=call.step_downs,
                out_of_time=error.out_of_time and request.seconds < settings.deadline,
            ) from None
        finally:
            self._features = call.features
        retries = call.requests - call.step_downs - 1
        stats = replace(completion.stats, retries=retries, step_downs=call.step_downs)
        return replace(completion, stats=stats, notes=tuple(call.notes))

    def close(self) -> None:
        """Close the connections that are kept open."""
        self._session.close()

    def __repr__(self) -> str:
        return f"HttpBackend({self._settings!r})"
