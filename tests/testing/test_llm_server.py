"""The model server: it speaks chat completions, misbehaves as it is told, and leaves nothing behind."""

import json
import socket
import struct
import threading
from concurrent.futures import ThreadPoolExecutor
from contextlib import ExitStack
from time import sleep
from urllib.parse import urlsplit

import pytest
import requests
from chat_client import ASKED, PLAN, ask, refused, said

from llm3.testing import Faults, LLMServer, ScriptedLLM, stand_in_script
from llm3.types import Completion, Context, Message, Request, Stats


@pytest.mark.parametrize("script", [["one", "two"], ScriptedLLM(["one", "two"]), iter(("one", "two"))])
def test_replies_come_in_order(script):
    with LLMServer(script) as server:
        assert [said(ask(server)), said(ask(server))] == ["one", "two"]
    assert server.requests == [ASKED, ASKED]
    assert server.answers == ["reply", "reply"]


def test_an_answer_has_the_fields_of_a_chat_completion():
    with LLMServer([PLAN]) as server:
        answer = ask(server).json()
    assert answer["object"] == "chat.completion"
    assert answer["model"] == "toy"
    assert answer["choices"] == [
        {"index": 0, "message": {"role": "assistant", "content": PLAN}, "finish_reason": "stop"}
    ]
    assert answer["usage"] == {
        "prompt_tokens": len("Plan, please!") // 4,
        "completion_tokens": len(PLAN) // 4,
        "total_tokens": len("Plan, please!") // 4 + len(PLAN) // 4,
        "prompt_tokens_details": {"cached_tokens": 0},
        "completion_tokens_details": {"reasoning_tokens": 0},
    }


def test_what_a_completion_tells_is_told():
    stats = Stats(prompt_tokens=50, cached_tokens=20, completion_tokens=9, reasoning_tokens=4)
    completion = Completion(PLAN, stats, model="toy-2", finish_reason="length", reasoning="let me see")
    with LLMServer([completion]) as server:
        answer = ask(server).json()
    assert answer["model"] == "toy-2"
    assert answer["choices"][0]["finish_reason"] == "length"
    assert answer["choices"][0]["message"]["reasoning_content"] == "let me see"
    assert answer["usage"] == {
        "prompt_tokens": 50,
        "completion_tokens": 9,
        "total_tokens": 59,
        "prompt_tokens_details": {"cached_tokens": 20},
        "completion_tokens_details": {"reasoning_tokens": 4},
    }


def test_a_function_answers_what_was_asked():
    with LLMServer(lambda request: request.messages[0].content.upper()) as server:
        assert said(ask(server)) == "PLAN, PLEASE!"


class Client(ScriptedLLM):
    """A backend that asks the server."""

    def __init__(self, server):
        super().__init__(lambda request: said(self.post(request)))
        self.server = server

    def post(self, request):
        return ask(self.server, messages=[{"role": m.role, "content": m.content} for m in request.messages])


def test_a_stand_in_answers_from_the_context_that_a_tap_hears():
    request = Request((Message("user", "Plan!"),), Context("Go home.", (), (), ()), seed=7)
    script = stand_in_script(lambda context, rng: f"{context.task} {rng.integers(1000)}")
    with LLMServer(script) as server:
        plain = Client(server)
        tapped = server.tap(plain)
        assert plain.complete(request).text.split()[0].isdecimal()
        assert tapped.complete(request).text == script(request)
        assert (tapped.is_language_model, tapped.notice) == (plain.is_language_model, plain.notice)
        assert tapped.last_words == plain.last_words
        assert tapped.examine() == plain.examine()
        tapped.close()


@pytest.mark.parametrize(
    ("refuses", "field", "value", "sentence"),
    [
        ("temperature", "temperature", 0.5, "Invalid parameter: 'temperature' is not supported with this model."),
        (
            "response_format",
            "response_format",
            {"type": "json_object"},
            "Invalid parameter: 'response_format' of type 'json_object' is not supported with this model.",
        ),
        (
            "json_schema",
            "response_format",
            {"type": "json_schema", "json_schema": {}},
            "Invalid parameter: 'response_format' of type 'json_schema' is not supported with this model.",
        ),
    ],
)
def test_a_field_can_be_refused(refuses, field, value, sentence):
    with LLMServer(["one", "two"], refuses=[refuses]) as server:
        response = ask(server, **{field: value})
        assert refused(response) == sentence
        assert response.json()["error"]["param"] == field
        assert said(ask(server)) == "one"
        assert said(ask(server, response_format={"type": "text"})) == "two" if refuses == "json_schema" else True
    assert server.answers[:2] == [f"refused {field}", "reply"]


@pytest.mark.parametrize(
    ("body", "sentence"),
    [
        (b"Hello", "the request must be a JSON object"),
        (b"[" * 100_000, "the request must be a JSON object"),
        (b'{"messages": []}', "the request must name a 'model'"),
        (b'{"model": "toy"}', "the request must have a list of 'messages'"),
        (
            b'{"model": "toy", "messages": ["Hello"]}',
            "each of the 'messages' must have a 'role' and a 'content', both texts",
        ),
        (json.dumps({**ASKED, "stream": True}).encode(), "'stream' is not supported here"),
    ],
)
def test_what_is_no_request_is_refused(body, sentence):
    with LLMServer(["one"]) as server:
        response = requests.post(f"{server.url}/chat/completions", data=body, timeout=10)
        assert refused(response) == sentence
    assert server.answers == ["error"]


def test_another_path_is_not_there():
    with LLMServer(["one"]) as server:
        response = requests.post(f"{server.url}/messages", json=ASKED, timeout=10)
    assert response.status_code == 404
    assert response.json()["error"]["message"] == "there is no /v1/messages, only /v1/chat/completions"


@pytest.mark.parametrize(
    ("script", "sentence"),
    [
        ([], "the script has run out after 0 replies."),
        ([KeyboardInterrupt()], "KeyboardInterrupt"),
        (lambda request: {}[request.seed], "0"),
    ],
)
def test_what_a_script_raises_is_told_and_harms_nobody(script, sentence):
    with LLMServer(script) as server:
        assert refused(ask(server)) == sentence
    assert server.answers == ["error"]


def test_clients_at_the_same_time_are_all_answered():
    with LLMServer(map(str, range(20))) as server:
        answers = []
        threads = [threading.Thread(target=lambda: answers.append(said(ask(server)))) for _ in range(20)]
        for thread in threads:
            thread.start()
        for thread in threads:
            thread.join()
    assert sorted(answers, key=int) == [str(n) for n in range(20)]


def test_a_client_that_breaks_off_is_no_trouble(capfd):
    with LLMServer(["one"]) as server:
        address = urlsplit(server.url)
        for sent in (b"", b"POST /v1/chat/completions HTTP/1.1\r\n", b"POST / HTTP/1.0\r\nContent-Length: 9\r\n\r\n{"):
            with socket.create_connection((address.hostname, address.port)) as client:
                client.setsockopt(socket.SOL_SOCKET, socket.SO_LINGER, struct.pack("ii", 1, 0))  # close with a reset
                client.sendall(sent)
        assert said(ask(server)) == "one"
    assert capfd.readouterr().err == ""


def test_closing_ends_whoever_waits():
    with LLMServer(["one"], faults=Faults.at({1: "timeout"})) as server:
        waiting = socket.create_connection((urlsplit(server.url).hostname, urlsplit(server.url).port))
        with ThreadPoolExecutor() as pool:
            hopeful = pool.submit(ask, server, timeout=60)
            while not server.answers and not hopeful.done():
                sleep(0.01)
            server.close()
            assert isinstance(hopeful.exception(), requests.ConnectionError)
        assert waiting.recv(1) == b""
        waiting.close()


def test_it_can_be_closed_twice_and_started_again():
    server = LLMServer(["one", "two"])
    server.close()
    for text in ("one", "two"):
        server.start()
        server.start()
        assert said(ask(server)) == text
        server.close()
        server.close()
    with pytest.raises(RuntimeError) as caught:
        server.url  # noqa: B018  # asking is the test
    assert str(caught.value) == "the server is not running: use it in a 'with', or call start()"


def test_several_run_beside_one_another():
    with ExitStack() as running:
        servers = [running.enter_context(LLMServer([name])) for name in "ab"]
        assert [said(ask(server)) for server in servers] == ["a", "b"]


def test_one_text_is_no_list_of_what_to_refuse():
    with pytest.raises(TypeError) as caught:
        LLMServer(["one"], refuses="temperature")
    assert str(caught.value) == "refuses is a list of names, not one text: write refuses=['temperature']"
