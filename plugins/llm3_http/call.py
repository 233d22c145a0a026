"""One call: the requests that it takes to get one answer, and what they came to."""

from __future__ import annotations

from collections.abc import Callable

import requests

from llm3.types import Completion, Request
from llm3_http.context_window import check_whole
from llm3_http.dialect import Dialect
from llm3_http.features import Features, difference, fewer_features
from llm3_http.reply import read_completion, server_message
from llm3_http.settings import HttpSettings
from llm3_http.statuses import check_status
from llm3_http.transport import Reply, exchange
from llm3_http.watchdog import Watchdog


class Call:
    """Asks with fewer features where the server refuses one, and keeps count of all its requests."""

    def __init__(
        self,
        session: requests.Session,
        watchdog: Watchdog,
        settings: HttpSettings,
        dialect: Dialect,
        request: Request,
        features: Features,
    ) -> None:
        """Make a call; nothing is sent yet."""
        self._session, self._watchdog, self._settings = session, watchdog, settings
        self._dialect, self._request = dialect, request
        self.features = features
        """What the server has not refused so far."""
        self.notes: list[str] = []
        self.requests = 0
        """All that were made: retries, step-downs, and the one that got the answer."""
        self.step_downs = 0

    def note(self, line: str) -> None:
        """Keep a line for the record."""
        self.notes.append(line)

    def ask(
        self, attempt: int, *, until: float, clock: Callable[[], float], wall_clock: Callable[[], float]
    ) -> Completion:
        """Try once, which takes another request for each feature that is refused.

        Args:
            attempt: Counted from 1, for the sentence of a failure.
            until: When the answer must be here, by the clock.
            clock: Monotonic seconds.
            wall_clock: Seconds since the epoch.

        Raises:
            TryAgain: No answer, in a way that may pass.
            BackendError: No answer, and none to be expected.
        """
        settings = self._settings
        while True:
            self.requests += 1
            reply = self._exchange(until, clock)
            fewer = fewer_features(self.features, reply.status, server_message(reply.body))
            if fewer is None:
                break
            self.step_downs += 1
            self.note(f"status {reply.status}: {difference(self.features, fewer)}")
            self.features = fewer
        check_status(reply, settings, attempt=attempt, now=wall_clock())
        completion = read_completion(reply.body, settings, self._dialect)
        check_whole(self._request.messages, completion.stats.prompt_tokens, settings)
        return completion

    def _exchange(self, until: float, clock: Callable[[], float]) -> Reply:
        payload = self._dialect.payload(self._settings, self.features, self._request)
        return exchange(self._session, self._watchdog, self._settings, self._dialect, payload, until=until, clock=clock)
