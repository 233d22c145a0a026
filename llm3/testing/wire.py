"""Faults of the wire: what may come, or not, in the place of an answer."""

from __future__ import annotations

import json
import socket
from collections.abc import Mapping
from http.server import BaseHTTPRequestHandler
from types import MappingProxyType
from typing import Any

from llm3.testing.loopback import Answer

PATIENCE = 30.0
"""Seconds after which the server hangs up on a client that waits in vain."""
_PAUSE = 0.02
"""Seconds between two bytes of a slow answer."""


def send_json(handler: BaseHTTPRequestHandler, body: Any, status: int = 200, **headers: str) -> None:
    """A complete answer."""
    _send(handler, json.dumps(body).encode(), status, **headers)


def error_body(message: str, param: str | None = None) -> dict[str, Any]:
    """An error as OpenAI words it."""
    return {"error": {"message": message, "type": "invalid_request_error", "param": param, "code": None}}


def _send(handler: BaseHTTPRequestHandler, body: bytes, status: int = 200, **headers: str) -> None:
    _start(handler, status, Content_Length=str(len(body)), **headers)
    handler.wfile.write(body)


def _start(handler: BaseHTTPRequestHandler, status: int, **headers: str) -> None:
    handler.send_response(status)
    for name, value in {"Content_Type": "application/json", **headers}.items():
        handler.send_header(name.replace("_", "-"), value)
    handler.end_headers()


def _status(status: int, message: str, **headers: str) -> Answer:
    return lambda handler: send_json(handler, error_body(message), status, **headers)


def _silence(handler: BaseHTTPRequestHandler) -> None:
    _gone(handler, PATIENCE)


def _slow(handler: BaseHTTPRequestHandler) -> None:
    _start(handler, 200)
    for byte in b"{" + b" " * int(PATIENCE / _PAUSE):
        handler.wfile.write(bytes([byte]))
        if _gone(handler, _PAUSE):
            return


def _gone(handler: BaseHTTPRequestHandler, patience: float) -> bool:
    """Whether somebody hangs up, the client or the closing server, within so many seconds."""
    handler.connection.settimeout(patience)
    try:
        handler.connection.recv(1, socket.MSG_PEEK)
    except TimeoutError:
        return False
    return True


def _dropped(handler: BaseHTTPRequestHandler) -> None:
    handler.connection.shutdown(socket.SHUT_RDWR)


def _broken(handler: BaseHTTPRequestHandler) -> None:
    _send(handler, b'{"id": "chatcmpl-1", "object": "chat.completion", "choices": [{"index": 0, "mess')


WIRE_FAULTS: Mapping[str, Answer] = MappingProxyType(
    {
        "429": _status(429, "Rate limit reached."),
        "429 with Retry-After": _status(429, "Rate limit reached.", Retry_After="2"),
        "500": _status(500, "The server had an error."),
        "503": _status(503, "The engine is overloaded."),
        "timeout": _silence,
        "dropped connection": _dropped,
        "broken JSON envelope": _broken,
        "slow, byte by byte": _slow,
    }
)
"""Every fault of the wire by its name. Those that keep a client waiting end when it hangs up, or after 30 s."""
