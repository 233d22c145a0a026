"""The one retry layer: what may pass by itself, and how long to wait. The figures are in `settings`."""

from __future__ import annotations

import math
import re
from collections.abc import Callable
from datetime import timezone
from email.utils import parsedate_to_datetime
from typing import TypeVar

import numpy as np
from tenacity import RetryCallState, Retrying, retry_if_exception_type

from llm3.errors import BackendError
from llm3_http.settings import HttpSettings
from llm3_http.wording import seconds

T = TypeVar("T")
_LONGEST = 1e9
"""Seconds, some thirty years: whatever is longer reads as this."""


_BUSY = frozenset({408, 409, 425, 429})


def may_pass(status: int) -> bool:
    """Whether a server that answers with this status may answer otherwise soon."""
    return status in _BUSY or status >= 500


class TryAgain(Exception):
    """A request failed in a way that may pass. It never leaves this package."""

    def __init__(self, sentence: str, cause: str, retry_after: float | None = None) -> None:
        """Say what happened.

        Args:
            sentence: What the user reads if it does not pass.
            cause: The same in few words, for a note.
            retry_after: Seconds that the server asks to wait.
        """
        super().__init__(sentence)
        self.cause, self.retry_after = cause, retry_after


def read_retry_after(header: str | None, now: float) -> float | None:
    """The seconds that a Retry-After header asks for (RFC 9110, section 10.2.3), or None if it says nothing usable.

    Args:
        header: The value: a number of seconds, or an HTTP date.
        now: Seconds since the epoch, by the wall clock.
    """
    text = (header or "").strip()
    if re.fullmatch(r"[0-9]+(\.[0-9]*)?", text):
        return min(float(text), _LONGEST)
    try:
        date = parsedate_to_datetime(text)
        moment = date.replace(tzinfo=date.tzinfo or timezone.utc).timestamp()
    except (ValueError, TypeError, OverflowError):  # what the standard library says of a date that is none
        return None
    return max(0.0, min(moment - now, _LONGEST))


def backoff(settings: HttpSettings, attempt: int, draw: float) -> float:
    """Seconds to wait after an attempt: doubling, of which the upper half is random.

    Args:
        settings: For the first and the longest wait.
        attempt: Counted from 1.
        draw: Uniform in [0, 1).
    """
    whole = min(settings.longest_wait, math.ldexp(settings.first_wait, min(attempt - 1, 64)))
    return whole * (0.5 + 0.5 * draw)


def persist(
    ask: Callable[[int], T],
    settings: HttpSettings,
    *,
    until: float,
    note: Callable[[str], None],
    rng: np.random.Generator,
    sleep: Callable[[float], None],
    clock: Callable[[], float],
) -> T:
    """Ask until there is an answer, an error that will not pass, or no attempt or time left.

    Args:
        ask: One attempt; it is told its number, counted from 1, and raises TryAgain where another may help.
        settings: For the number of attempts and the waits.
        until: When to give up, by the clock. A wait that would end later is not begun.
        note: Is told of each retry in a line: what went wrong, and how long it waits.
        rng: For the jitter.
        sleep: Waits for a number of seconds.
        clock: Monotonic seconds.

    Raises:
        BackendError: What the last TryAgain said; out of time where it was not the last attempt.
    """
    draws = rng.random(settings.max_attempts)

    def wait(state: RetryCallState) -> float:
        failure = state.outcome.exception() if state.outcome else None
        asked = failure.retry_after if isinstance(failure, TryAgain) else None
        return asked or backoff(settings, state.attempt_number, float(draws[state.attempt_number - 1]))

    def give_up(state: RetryCallState) -> bool:
        return state.attempt_number >= settings.max_attempts or clock() + wait(state) >= until

    def tell(state: RetryCallState) -> None:
        failure = state.outcome.exception() if state.outcome else None
        if isinstance(failure, TryAgain):
            note(f"{failure.cause}; asked again after {seconds(wait(state))}")

    attempts = Retrying(
        retry=retry_if_exception_type(TryAgain), wait=wait, stop=give_up, before_sleep=tell, sleep=sleep, reraise=True
    )
    try:
        return attempts(lambda: ask(attempts.statistics["attempt_number"]))
    except TryAgain as failure:
        sentence, left = str(failure), max(0.0, until - clock())
        if failure.retry_after is not None and failure.retry_after >= left:
            sentence += (
                f"; it asks to wait {seconds(failure.retry_after)}, but this call may only take another {seconds(left)}"
            )
        out_of_time = attempts.statistics["attempt_number"] < settings.max_attempts
        raise BackendError(sentence, out_of_time=out_of_time) from None
