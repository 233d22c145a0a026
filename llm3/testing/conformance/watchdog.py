"""Ends a query that goes on and on."""

from __future__ import annotations

import signal
import threading
from collections.abc import Iterator
from contextlib import contextmanager
from types import FrameType

AGAIN = 1.0
"""Seconds until it barks again, at a planner that takes the first time for an error of something else."""


class NoEnd(BaseException):
    """A query goes on and on. It is no `Exception`, as a planner may catch those and go on; no caller sees it."""


def can_watch() -> bool:
    """Whether there is an alarm to be had: on a POSIX system, in the main thread, where none is set."""
    main = threading.current_thread() is threading.main_thread()
    return hasattr(signal, "setitimer") and main and not any(signal.getitimer(signal.ITIMER_REAL))


@contextmanager
def watched(seconds: float) -> Iterator[None]:
    """Raise `NoEnd` inside of the block if it takes longer; where there is no alarm to be had, it may take for ever."""
    if not can_watch():
        yield
        return

    def bark(_number: int, _frame: FrameType | None) -> None:
        raise NoEnd

    before = signal.signal(signal.SIGALRM, bark)
    signal.setitimer(signal.ITIMER_REAL, seconds, AGAIN)
    try:
        yield
    finally:
        signal.setitimer(signal.ITIMER_REAL, 0.0)
        signal.signal(signal.SIGALRM, before)
