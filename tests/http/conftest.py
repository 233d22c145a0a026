from __future__ import annotations

import threading
from collections.abc import Callable, Iterator, Mapping
from types import MappingProxyType
from typing import Any

import numpy as np
import pytest
import requests
from model_server import QUESTION, Answer, ModelServer, Time

from llm3.errors import BackendError
from llm3.types import Completion, Request
from llm3_http.backend import HttpBackend
from llm3_http.presets import Preset
from llm3_http.secret import Secret
from llm3_http.settings import HttpSettings


@pytest.fixture(autouse=True)
def no_surroundings(monkeypatch: pytest.MonkeyPatch) -> None:
    """The proxies and certificates of this machine are not part of the tests."""
    for name in ("HTTP_PROXY", "HTTPS_PROXY", "ALL_PROXY", "NO_PROXY", "NETRC", "REQUESTS_CA_BUNDLE"):
        monkeypatch.delenv(name, raising=False)
        monkeypatch.delenv(name.lower(), raising=False)


@pytest.fixture
def server() -> Iterator[ModelServer]:
    before = set(threading.enumerate())
    with ModelServer() as running:
        thread = threading.Thread(target=running.serve_forever, kwargs={"poll_interval": 0.01})
        thread.start()
        yield running
        running.closing.set()
        running.shutdown()
        thread.join()
    assert set(threading.enumerate()) <= before


@pytest.fixture
def time() -> Time:
    return Time()


@pytest.fixture
def connect(server: ModelServer, time: Time) -> Iterator[Callable[..., HttpBackend]]:
    """Makes backends for the server, or for another address."""
    made: list[HttpBackend] = []

    def make(
        *,
        key: str = "",
        base_url: str = "",
        session_factory: Callable[[], requests.Session] = requests.Session,
        sleep: Callable[[float], None] = time.sleep,
        preset: Mapping[str, Any] = MappingProxyType({}),
        **limits: Any,
    ) -> HttpBackend:
        settings = HttpSettings("asked-model", Preset(base_url or server.url, **preset), Secret(key), **limits)
        backend = HttpBackend(
            settings,
            rng=np.random.default_rng(0),
            session_factory=session_factory,
            sleep=sleep,
            clock=time.clock,
            wall_clock=time.clock,
        )
        made.append(backend)
        return backend

    yield make
    for backend in made:
        backend.close()
        backend.close()


@pytest.fixture
def complete(server: ModelServer, connect: Callable[..., HttpBackend]) -> Callable[..., Completion]:
    """What comes of one question when the server follows this script."""

    def run(*script: Answer, question: Request = QUESTION, **arguments: object) -> Completion:
        server.script = script or server.script
        return connect(**arguments).complete(question)

    return run


@pytest.fixture
def failure(complete: Callable[..., Completion]) -> Callable[..., str]:
    """The sentence in which one question ends when the server follows this script."""

    def run(*script: Answer, **arguments: object) -> str:
        with pytest.raises(BackendError) as caught:
            complete(*script, **arguments)
        sentence = str(caught.value)
        assert sentence.isprintable()
        return sentence

    return run
