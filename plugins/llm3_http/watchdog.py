"""An end to a request that a server keeps alive with crumbs: no timeout of a socket sees those."""

from __future__ import annotations

import socket
from collections.abc import Iterator
from contextlib import contextmanager, suppress
from threading import Event, Lock, Thread
from typing import Any
from weakref import WeakSet

import requests
from requests.adapters import HTTPAdapter


class Alarm:
    """Whether the time of a request was over before it was done."""

    def __init__(self) -> None:
        self.went_off = False


class Watchdog(HTTPAdapter):
    """Knows the connections of a session, and cuts them off when a request's time is over.

    Timeouts bound the wait for the next piece of an answer. A server that sends a piece now and then, within a header
    or before one, can keep a request waiting for as long as it likes.
    """

    def __init__(self) -> None:
        """Make an adapter for one session; it is mounted by `watched`."""
        super().__init__()
        self._connections: WeakSet[Any] = WeakSet()
        self._lock = Lock()

    def get_connection_with_tls_context(self, *arguments: Any, **keywords: Any) -> Any:
        """The pool of connections for a request, whose new connections are known from now on."""
        pool: Any = super().get_connection_with_tls_context(*arguments, **keywords)
        if not hasattr(pool.ConnectionCls, "watched"):
            pool.ConnectionCls = self._known(pool.ConnectionCls)
        return pool

    @contextmanager
    def cutting_off_after(self, seconds: float) -> Iterator[Alarm]:
        """Cut off the session's connections if the block takes longer than this."""
        alarm, done = Alarm(), Event()

        def watch() -> None:
            if not done.wait(seconds):
                alarm.went_off = True
                self._cut_off()

        thread = Thread(target=watch, name="llm3 request watchdog", daemon=True)
        thread.start()
        try:
            yield alarm
        finally:
            done.set()
            thread.join()

    def _known(self, kind: type[Any]) -> type[Any]:
        """A kind of connection that is remembered when it connects."""
        connections, lock = self._connections, self._lock

        class Known(kind):  # type: ignore[misc]  # urllib3 chooses the class, for http and for https
            watched = True

            def connect(self) -> None:
                with lock:
                    connections.add(self)
                super().connect()

        return Known

    def _cut_off(self) -> None:
        with self._lock:
            open_ = [connection.sock for connection in self._connections]
        for sock in filter(None, open_):
            with suppress(OSError):
                sock.shutdown(socket.SHUT_RDWR)


def watched(session: requests.Session) -> Watchdog:
    """Mount a watchdog on a session."""
    watchdog = Watchdog()
    session.mount("http://", watchdog)
    session.mount("https://", watchdog)
    return watchdog
