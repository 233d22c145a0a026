"""A model server on loopback for tests."""

from __future__ import annotations

import json
import threading
from collections.abc import Collection
from types import TracebackType
from typing import Any

from llm3.interfaces import LLMBackend
from llm3.testing.chat import chat_completion, messages_of, refusal, refused
from llm3.testing.faults import REPLY_FAULTS
from llm3.testing.faulty import Spoiler
from llm3.testing.loopback import Answer, LoopbackHTTP
from llm3.testing.schedule import Faults
from llm3.testing.scripted import Script, ScriptedLLM
from llm3.testing.tapped import Tapped
from llm3.testing.wire import PATIENCE, WIRE_FAULTS, error_body, send_json
from llm3.types import Context, Message, Request


class LLMServer:
    """A real HTTP server on 127.0.0.1 that speaks OpenAI's chat completions, and misbehaves as it is told.

    It runs inside of a ``with``, or between `start` and `close`; after that no thread and no socket is left. Requests
    may come at the same time; their replies are asked for one after another.
    """

    def __init__(
        self, script: Script | LLMBackend, *, faults: Faults | None = None, refuses: Collection[str] = ()
    ) -> None:
        """Take what to answer; nothing listens yet.

        Args:
            script: The replies, as `ScriptedLLM` takes them, or a backend that writes them. Where one raises an
                exception, the server answers 400 and the exception's text.
            faults: Which requests are answered with a fault; any of `REPLY_FAULTS` and `WIRE_FAULTS`. Requests that
                are refused are not counted. A fault of the wire takes no reply from the script.
            refuses: What is refused with 400: fields of the request, such as ``"temperature"``, and types of its
                `response_format`, such as ``"json_schema"``.

        Raises:
            UnknownName: There is no fault of this name.
            TypeError: `refuses` is one text; its characters would be the names.
        """
        if isinstance(refuses, str):
            raise TypeError(f"refuses is a list of names, not one text: write refuses=[{refuses!r}]")
        faults = faults or Faults.at({})
        faults.check([*REPLY_FAULTS, *WIRE_FAULTS])
        self.requests: list[Any] = []
        """The JSON of every request; None for one that is no JSON."""
        self.answers: list[str] = []
        """What became of each request: ``"reply"``, the name of a fault, ``"refused FIELD"`` or ``"error"``."""
        self._backend = script if isinstance(script, LLMBackend) else ScriptedLLM(script)
        self._faults, self._spoil, self._refuses = faults, Spoiler(faults), tuple(refuses)
        self._known: dict[tuple[Message, ...], Request] = {}
        self._taken = 0  # requests that were not refused
        self._lock = threading.Lock()
        self._http: LoopbackHTTP | None = None
        self._thread: threading.Thread | None = None

    @property
    def url(self) -> str:
        """The base URL, such as ``http://127.0.0.1:40123/v1``: what LLM3_BASE_URL is set to.

        Raises:
            RuntimeError: It is not running.
        """
        if self._http is None:
            raise RuntimeError("the server is not running: use it in a 'with', or call start()")
        return f"http://127.0.0.1:{self._http.server_port}/v1"

    def start(self) -> None:
        """Listen on a free port."""
        if self._http is None:
            self._http = LoopbackHTTP(self._decide, PATIENCE)
            # The interval is how long closing may take, not how long an answer waits.
            self._thread = threading.Thread(target=self._http.serve_forever, args=(0.02,), name="llm3 model server")
            self._thread.start()

    def close(self) -> None:
        """Hang up on everybody, and wait for the threads to end. Calling it twice does no harm."""
        http, thread, self._http, self._thread = self._http, self._thread, None, None
        if http is not None and thread is not None:
            http.shutdown()
            thread.join()
            http.hang_up()
            http.server_close()

    def __enter__(self) -> LLMServer:
        self.start()
        return self

    def __exit__(
        self, kind: type[BaseException] | None, error: BaseException | None, traceback: TracebackType | None
    ) -> None:
        self.close()

    def tap(self, backend: LLMBackend) -> LLMBackend:
        """The same backend, whose requests this server sees whole.

        HTTP carries the messages only. A script that answers from `Request.context`, such as a domain's stand-in,
        needs the rest; without a tap the context is empty.
        """
        return Tapped(backend, self._learn)

    def _learn(self, request: Request) -> None:
        self._known[request.messages] = request

    def _decide(self, path: str, body: bytes) -> Answer:
        with self._lock:
            payload = _parsed(body)
            self.requests.append(payload)
            what, answer = self._answer(path, payload)
            self.answers.append(what)
            return answer

    def _answer(self, path: str, payload: Any) -> tuple[str, Answer]:
        if path.partition("?")[0] != "/v1/chat/completions":
            return "error", _error(404, f"there is no {path}, only /v1/chat/completions")
        try:
            messages = messages_of(payload)
        except ValueError as error:
            return "error", _error(400, str(error))
        if field := refused(payload, self._refuses):
            return f"refused {field}", _error(400, refusal(payload, field), field)
        self._taken += 1
        fault = self._faults.choose(self._taken)
        if fault in WIRE_FAULTS:
            return str(fault), WIRE_FAULTS[str(fault)]
        try:
            good = self._backend.complete(self._known.get(messages) or Request(messages, Context("", (), (), ())))
        except BaseException as error:  # whatever a script raises: it must not end the server's thread
            return "error", _error(400, str(error) or type(error).__name__)
        reply = self._spoil(good, fault)
        return fault or "reply", lambda handler: send_json(handler, chat_completion(reply, payload))


def _error(status: int, message: str, param: str | None = None) -> Answer:
    return lambda handler: send_json(handler, error_body(message, param), status)


def _parsed(body: bytes) -> Any:
    try:
        return json.loads(body)
    except (ValueError, RecursionError):
        return None
