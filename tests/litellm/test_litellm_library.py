"""The backend `litellm` with the library itself, against a server on loopback.

It runs in a process of its own: LiteLLM takes seconds to import, starts threads and warns of much.
"""

from __future__ import annotations

import json
import os
import subprocess
import sys

import pytest

from llm3.testing import Faults, LLMServer

PROGRAM = """
import json, sys
from dataclasses import asdict
from llm3.errors import LLM3Error
from llm3.interfaces import BackendSettings
from llm3.registry import Registry
from llm3.types import Context, Message, Request

backend = Registry.discover().backend("litellm", BackendSettings(model="openai/small", temperature=0.5))
try:
    told = asdict(backend.complete(Request((Message("user", "a plan"),), Context("", (), (), ()))))
    told["stats"]["seconds"] = dict(told["stats"]["seconds"])
except LLM3Error as error:
    told = {"error": str(error), "retries": error.retries}
print(json.dumps(told))
"""
KEY = "sk-canary-0123456789"


def ask(server: LLMServer) -> dict:
    settings = {"OPENAI_API_BASE": server.url, "OPENAI_API_KEY": KEY, "NO_PROXY": "127.0.0.1"}
    environment = {**os.environ, "PYTHONPATH": os.pathsep.join(sys.path), **settings}
    done = subprocess.run(
        [sys.executable, "-c", PROGRAM], env=environment, capture_output=True, text=True, timeout=120, check=False
    )
    assert done.returncode == 0, done.stderr
    assert KEY not in done.stdout + done.stderr
    told: dict = json.loads(done.stdout.splitlines()[-1])
    return told


@pytest.mark.slow
def test_a_reply_comes_through_the_library():
    with LLMServer(["the plan"]) as server:
        told = ask(server)
    assert (told["text"], told["finish_reason"]) == ("the plan", "stop")
    assert told["stats"]["prompt_tokens"] > 0
    assert told["stats"]["completion_tokens"] > 0
    (request,) = server.requests
    assert request["messages"] == [{"role": "user", "content": "a plan"}]
    assert (request["model"], request["temperature"]) == ("small", 0.5)


@pytest.mark.slow
def test_there_is_one_retry_layer_and_it_is_recorded():
    with LLMServer(["the plan"], faults=Faults.at({1: "500"})) as server:
        told = ask(server)
    assert told["text"] == "the plan"
    assert len(server.requests) == 2 == told["stats"]["retries"] + 1
    assert "The server had an error.; asked again after" in told["notes"][0]


@pytest.mark.slow
def test_a_refusal_is_one_line_after_one_request():
    with LLMServer(["the plan"], refuses=["temperature"]) as server:
        told = ask(server)
    assert told["error"].startswith("LiteLLM gets no answer from 'openai/small': BadRequestError: ")
    assert "\n" not in told["error"]
    assert len(server.requests) == told["retries"] == 1
