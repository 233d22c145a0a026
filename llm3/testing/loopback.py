"""HTTP on 127.0.0.1 that ends cleanly, and knows nothing of models."""

from __future__ import annotations

import contextlib
import socket
import sys
from collections.abc import Callable
from http.server import BaseHTTPRequestHandler, ThreadingHTTPServer
from typing import Any

Answer = Callable[[BaseHTTPRequestHandler], None]
"""Writes an answer to a connection."""


class LoopbackHTTP(ThreadingHTTPServer):
    """Answers POST. It knows its open connections, so that none of them can keep it from closing."""

    daemon_threads = False  # so that closing waits for them
    request_queue_size = 64

    def __init__(self, decide: Callable[[str, bytes], Answer], patience: float) -> None:
        """Listen on a free port.

        Args:
            decide: The answer to a request's path and body. Requests come in threads of their own.
            patience: Seconds after which it hangs up on a client that sends nothing.
        """
        super().__init__(("127.0.0.1", 0), _Handler)
        self.decide, self.patience = decide, patience
        self._open: set[Any] = set()

    def process_request(self, request: Any, client_address: Any) -> None:
        """Remember the connection."""
        self._open.add(request)
        super().process_request(request, client_address)

    def shutdown_request(self, request: Any) -> None:
        """Forget the connection."""
        self._open.discard(request)
        super().shutdown_request(request)

    def handle_error(self, request: Any, client_address: Any) -> None:
        """Print what went wrong, unless it is that the client has had enough."""
        if not isinstance(sys.exc_info()[1], OSError):
            super().handle_error(request, client_address)

    def hang_up(self) -> None:
        """End every connection, so that whoever waits on one goes on."""
        for connection in tuple(self._open):
            with contextlib.suppress(OSError):  # the client was faster
                connection.shutdown(socket.SHUT_RDWR)


class _Handler(BaseHTTPRequestHandler):
    server: LoopbackHTTP

    def setup(self) -> None:
        self.request.settimeout(self.server.patience)
        super().setup()

    def do_POST(self) -> None:
        length = self.headers.get("Content-Length", "")
        body = self.rfile.read(int(length)) if length.isdecimal() else b""
        self.server.decide(self.path, body)(self)

    def log_message(self, *_: object) -> None:
        """Say nothing."""
