"""What is sent."""

from __future__ import annotations

import subprocess
import sys

import pytest
from model_server import QUESTION, answer, completion

from llm3.types import Completion, Stats

MESSAGES = [{"role": "system", "content": "You plan."}, {"role": "user", "content": "Pack the red box, größer."}]


def test_a_request_is_the_model_and_the_messages_and_nothing_else(complete, server):
    complete()
    (received,) = server.received
    assert received.path == "/v1/chat/completions"
    assert received.payload == {"model": "asked-model", "messages": MESSAGES}
    assert received.headers["content-type"] == "application/json"


@pytest.mark.parametrize("temperature", [0.0, 0.7])
def test_a_temperature_is_sent_when_the_user_gives_one(complete, server, temperature):
    complete(temperature=temperature)
    assert server.received[0].payload["temperature"] == temperature


def test_a_completion_tells_what_it_cost_and_who_answered(complete):
    body = completion("a plan", usage={"prompt_tokens": 12, "completion_tokens": 3, "total_tokens": 15})
    assert complete(answer(body)) == Completion(
        "a plan", Stats(prompt_tokens=12, completion_tokens=3), model="served-model", finish_reason="stop"
    )


def test_a_key_is_sent_as_a_bearer_token(complete, server):
    complete(key="sk-something")
    assert server.received[0].headers["authorization"] == "Bearer sk-something"


def test_without_a_key_no_credentials_are_sent_not_even_those_of_a_netrc(complete, server, tmp_path, monkeypatch):
    netrc = tmp_path / "netrc"
    netrc.write_text("machine 127.0.0.1 login someone password secret\n")
    netrc.chmod(0o600)
    monkeypatch.setenv("NETRC", str(netrc))
    complete()
    assert "authorization" not in server.received[0].headers


def test_a_netrc_does_not_displace_the_key(complete, server, tmp_path, monkeypatch):
    netrc = tmp_path / "netrc"
    netrc.write_text("machine 127.0.0.1 login someone password secret\n")
    netrc.chmod(0o600)
    monkeypatch.setenv("NETRC", str(netrc))
    complete(key="sk-something")
    assert server.received[0].headers["authorization"] == "Bearer sk-something"


def test_the_proxy_of_the_environment_is_used(complete, server, monkeypatch):
    monkeypatch.setenv("HTTP_PROXY", server.url.removesuffix("/v1"))
    assert complete(base_url="http://models.invalid/v1").text == "a plan"
    assert server.received[0].path == "http://models.invalid/v1/chat/completions"


def test_a_slash_at_the_end_of_the_address_makes_no_difference(complete, server):
    complete(base_url=f"{server.url}/")
    assert server.received[0].path == "/v1/chat/completions"


def test_a_backend_stands_for_a_language_model_and_answers_many_requests(connect, server):
    backend = connect()
    assert backend.is_language_model
    assert backend.notice == ""
    assert [backend.complete(QUESTION).text for _ in range(3)] == ["a plan"] * 3
    assert len(server.received) == 3


def test_a_connection_is_kept_until_the_backend_is_closed(connect, server):
    server.keep_alive = True
    backend = connect()
    for _ in range(3):
        backend.complete(QUESTION)
    assert (server.connections, len(server.received)) == (1, 3)
    backend.close()
    backend.complete(QUESTION)
    assert server.connections == 2


def test_registering_the_backend_loads_no_http_library():
    code = (
        "import sys; from llm3_http import plugin; assert list(plugin.llm3_backends()) == ['http'];"
        "print([name for name in ('requests', 'urllib3', 'tenacity') if name in sys.modules])"
    )
    path = f"import sys; sys.path[:0] = {sys.path!r};"
    done = subprocess.run([sys.executable, "-c", path + code], capture_output=True, text=True, check=True)
    assert done.stdout.strip() == "[]"
