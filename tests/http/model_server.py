"""A model server on loopback that follows a script, and time that passes only when told."""

from __future__ import annotations

import contextlib
import json
import socket
import threading
from collections.abc import Callable, Mapping
from dataclasses import dataclass, field, replace
from http.server import BaseHTTPRequestHandler, ThreadingHTTPServer
from typing import Any

from llm3.types import Context, Message, Request

Answer = Callable[[BaseHTTPRequestHandler], None]

QUESTION = Request(
    (Message("system", "You plan."), Message("user", "Pack the red box, größer.")),
    Context(task="pack", actions=(), objects=(), state=()),
)


SCHEMA = {"type": "object", "properties": {"Full Plan": {"type": "array"}}}
STRUCTURED = replace(QUESTION, schema=SCHEMA)


def completion(content: object = "a plan", finish_reason: str = "stop", **fields: object) -> dict[str, Any]:
    """The body of a usual answer."""
    choice = {"index": 0, "message": {"role": "assistant", "content": content}, "finish_reason": finish_reason}
    return {"model": "served-model", "choices": [choice]} | fields


def anthropic_completion(*blocks: object, **fields: object) -> dict[str, Any]:
    """The body of a usual answer of the Messages API; without blocks one text block."""
    content = list(blocks) or [{"type": "text", "text": "a plan"}]
    usual = {"type": "message", "role": "assistant", "model": "served-model", "stop_reason": "end_turn"}
    return usual | {"content": content} | fields


def answer(body: object = None, status: int = 200, headers: Mapping[str, str] | None = None) -> Answer:
    """A complete answer; a body that is not bytes is sent as JSON, and none is a usual one."""
    body = completion() if body is None else body
    sent = body if isinstance(body, bytes) else json.dumps(body).encode()

    def send(handler: BaseHTTPRequestHandler) -> None:
        _start(handler, status, {"Content-Length": str(len(sent))} | dict(headers or {}))
        handler.wfile.write(sent)

    return send


def refusal(status: int, message: str = "", **headers: str) -> Answer:
    """An error as OpenAI words it."""
    return answer({"error": {"message": message}}, status, {k.replace("_", "-"): v for k, v in headers.items()})


def broken_off(handler: BaseHTTPRequestHandler) -> None:
    """Promises more than it sends."""
    _start(handler, 200, {"Content-Length": "1000"})
    handler.wfile.write(b'{"choices"')


def broken_chunk(handler: BaseHTTPRequestHandler) -> None:
    """The same in a chunked answer."""
    _start(handler, 200, {"Transfer-Encoding": "chunked"})
    handler.wfile.write(b'100\r\n{"choices"')


def hung_up(handler: BaseHTTPRequestHandler) -> None:
    """Says nothing and closes."""
    handler.connection.shutdown(socket.SHUT_RDWR)


def garbage(handler: BaseHTTPRequestHandler) -> None:
    """Speaks another protocol."""
    handler.wfile.write(b"220 mail.example ESMTP\r\n\r\n")


def bad_compression(handler: BaseHTTPRequestHandler) -> None:
    """Claims to be compressed."""
    answer(b"not gzip", headers={"Content-Encoding": "gzip"})(handler)


def silence(handler: BaseHTTPRequestHandler) -> None:
    """Holds the line until the server closes."""
    handler.server.closing.wait(10)  # type: ignore[attr-defined]  # ModelServer sets it


def stalled(handler: BaseHTTPRequestHandler) -> None:
    """Begins its answer, and holds the line until the server closes."""
    _start(handler, 200, {"Content-Length": "1000"})
    handler.wfile.write(b'{"choices"')
    silence(handler)


def drip(handler: BaseHTTPRequestHandler) -> None:
    """Sends a byte every few milliseconds for some seconds, unless the client closes."""
    _start(handler, 200, {})
    for _ in range(1000):
        handler.server.closing.wait(0.002)  # type: ignore[attr-defined]  # ModelServer sets it
        handler.wfile.write(b" ")


def crumbs(beginning: bytes, crumb: bytes) -> Answer:
    """Goes on with crumbs for some seconds, unless the client closes; no wait between two of them is long."""

    def send(handler: BaseHTTPRequestHandler) -> None:
        handler.wfile.write(beginning)
        for _ in range(1000):
            handler.server.closing.wait(0.005)  # type: ignore[attr-defined]  # ModelServer sets it
            handler.wfile.write(crumb)
            handler.wfile.flush()

    return send


def flood(handler: BaseHTTPRequestHandler) -> None:
    """Sends more than anyone should read."""
    _start(handler, 200, {})
    for _ in range(200):
        handler.wfile.write(b" " * 65_536)


def _start(handler: BaseHTTPRequestHandler, status: int, headers: Mapping[str, str]) -> None:
    handler.send_response(status)
    for name, value in headers.items():
        handler.send_header(name, value)
    handler.end_headers()


@dataclass(frozen=True)
class Received:
    """A request as it came in."""

    path: str
    headers: Mapping[str, str]
    payload: Any


class _Handler(BaseHTTPRequestHandler):
    timeout = 10

    def setup(self) -> None:
        if self.server.keep_alive:
            self.protocol_version = "HTTP/1.1"
        self.server.connections += 1
        super().setup()

    def do_POST(self) -> None:
        body = self.rfile.read(int(self.headers["Content-Length"]))
        headers = {name.lower(): value for name, value in self.headers.items()}
        number = len(self.server.received)
        self.server.received.append(Received(self.path, headers, json.loads(body)))
        script = self.server.script
        with contextlib.suppress(ConnectionError):  # the client may have had enough
            script[min(number, len(script) - 1)](self)

    def log_message(self, *args: object) -> None:
        pass


class ModelServer(ThreadingHTTPServer):
    """Gives the answers of its script in order, and the last one again and again."""

    daemon_threads = False  # so that closing waits for every answer

    def __init__(self) -> None:
        super().__init__(("127.0.0.1", 0), _Handler)
        self.script: tuple[Answer, ...] = (answer(),)
        self.received: list[Received] = []
        self.keep_alive = False
        self.connections = 0
        self.closing = threading.Event()

    @property
    def url(self) -> str:
        return f"http://127.0.0.1:{self.server_port}/v1"


@dataclass
class Time:
    """Passes while someone sleeps, and by `step` whenever someone looks."""

    now: float = 1000.0
    step: float = 0.0
    naps: list[float] = field(default_factory=list)

    def clock(self) -> float:
        self.now += self.step
        return self.now

    def sleep(self, duration: float) -> None:
        self.naps.append(duration)
        self.now += duration
