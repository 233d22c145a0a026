"""`llm3 doctor`: one call, one line."""

from __future__ import annotations

import json
import os
import socket
from collections.abc import Callable

import pytest
from model_server import Answer, ModelServer, answer, anthropic_completion, completion, refusal

from llm3.cli.main import main
from llm3_http.context_window import LONG

REPLY = '{"Reasoning": "", "Full Plan": []}'
USAGE = {"prompt_tokens": 20, "completion_tokens": 9}
GOOD = answer(completion(REPLY, usage=USAGE))
CANARY = "sk-c4n4ry-4711"


@pytest.fixture
def surroundings(monkeypatch: pytest.MonkeyPatch) -> pytest.MonkeyPatch:
    for name in list(os.environ):
        if name.startswith("LLM3_") or name.endswith("_API_KEY"):
            monkeypatch.delenv(name)
    return monkeypatch


@pytest.fixture
def doctor(
    server: ModelServer, surroundings: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> Callable[..., tuple[int, str, str]]:
    """Examines a model behind the server that follows a script: exit code, stdout and stderr."""

    def run(*script: Answer, model: str = "vllm/m", more: str = "") -> tuple[int, str, str]:
        server.script = script or (GOOD,)
        surroundings.setenv("LLM3_BASE_URL", server.url)
        surroundings.setenv("LLM3_API_KEY", CANARY)
        code = main(["doctor", "--model", model, *more.split()])
        printed = capsys.readouterr()
        assert CANARY not in printed.out + printed.err
        return code, printed.out, printed.err

    return run


def test_a_model_that_answers_is_one_line(doctor, server):
    assert doctor() == (
        0,
        f"served-model answers at {server.url}: reply format json_schema; 20 tokens read, 9 written\n",
        "",
    )
    (received,) = server.received
    assert len(json.dumps(received.payload)) < 1000


def test_what_was_refused_is_said_and_is_no_error(doctor, server):
    no = refusal(400, "response_format is not supported")
    code, out, _ = doctor(no, no, GOOD)
    assert code == 0
    assert out == (
        f"served-model answers at {server.url}: no JSON mode, so replies are plain text; 20 tokens read, 9 written; "
        "status 400: the reply format json_schema is refused, and json_object is asked for from now on; "
        "status 400: the reply format json_object is refused, and text is asked for from now on\n"
    )


def test_a_format_that_is_taken_but_not_kept_to_is_said(doctor, server):
    _, out, _ = doctor(answer(completion("Sure! Here is your plan.", usage=USAGE)))
    assert f"{server.url}: reply format json_schema, which it takes but does not keep to; 20 tokens read" in out


def test_a_reply_that_was_cut_off_is_said(doctor):
    _, out, _ = doctor(answer(completion('{"Reas', "length", usage=USAGE)), more="--max-reply-tokens 9")
    assert out.endswith("; the reply was cut off at its limit, so give a larger --max-reply-tokens\n")


def test_a_window_that_is_too_small_is_found_out_where_the_server_says_nothing(doctor, server):
    small = answer(completion(REPLY, usage={"prompt_tokens": 4096, "completion_tokens": 9}))
    code, out, err = doctor(small, model="ollama/m")
    assert (code, out) == (3, "")
    assert err.startswith(f"llm3: error: the server at {server.url} read 4096 tokens of a prompt that has 60")
    large = answer(completion(REPLY, usage={"prompt_tokens": LONG + 50, "completion_tokens": 9}))
    server.received.clear()
    assert doctor(large, model="ollama/m")[0] == 0


@pytest.mark.parametrize(
    ("trouble", "says"),
    [
        (refusal(401, "no such key"), "refuses the key (401): set LLM3_API_KEY; it says: no such key"),
        (
            refusal(400, "API key not valid. Please pass a valid API key."),
            "refuses the key (400): set LLM3_API_KEY; it says: API key not valid. Please pass a valid API key.",
        ),
        (
            refusal(404, "no such model"),
            "has no model 'm', or is no such API (404): give another --model, or set LLM3_BASE_URL; "
            "it says: no such model",
        ),
        (refusal(429, "slow"), "answers 429 after 1 try: try again later, or give another --model; it says: slow"),
    ],
)
def test_what_is_wrong_is_one_line_after_one_request(doctor, server, trouble, says):
    assert doctor(trouble) == (3, "", f"llm3: error: the server at {server.url} {says}\n")
    assert len(server.received) == 1


def test_a_context_that_is_too_small_is_said(doctor, server):
    code, _, err = doctor(refusal(400, "maximum context length is 16 tokens"))
    assert code == 3
    assert err.startswith(f"llm3: error: the prompt does not fit into the context of model 'm' at {server.url} (400): ")


def test_a_server_that_is_not_there_is_not_waited_for(surroundings, capsys):
    with socket.create_server(("127.0.0.1", 0)) as taken:
        url = f"http://127.0.0.1:{taken.getsockname()[1]}/v1"
    surroundings.setenv("LLM3_BASE_URL", url)
    assert main(["doctor", "--model", "m"]) == 3
    assert capsys.readouterr().err == (f"llm3: error: no server answers at {url}: start it, or set LLM3_BASE_URL\n")


def test_a_missing_key_is_said_before_anything_is_sent(surroundings, capsys):
    assert main(["doctor", "--model", "anthropic/claude"]) == 3
    assert capsys.readouterr().err == (
        "llm3: error: https://api.anthropic.com/v1 needs a key: set LLM3_API_KEY or ANTHROPIC_API_KEY, "
        "or LLM3_BASE_URL for another server\n"
    )


def test_the_messages_api_is_examined_alike(server, surroundings, capsys, tmp_path):
    presets = {"mine": {"base_url": server.url, "dialect": "messages", "reply_formats": ["json_schema", "text"]}}
    presets["mine"]["max_reply_tokens"] = 1000
    (tmp_path / "presets.json").write_text(json.dumps(presets))
    surroundings.setenv("LLM3_PRESETS", str(tmp_path / "presets.json"))
    block = {"type": "text", "text": REPLY}
    server.script = (answer(anthropic_completion(block, usage={"input_tokens": 20, "output_tokens": 9})),)
    assert main(["doctor", "--model", "mine/claude"]) == 0
    assert capsys.readouterr().out == (
        f"served-model answers at {server.url}: reply format json_schema; 20 tokens read, 9 written\n"
    )


def test_the_doctor_asks_which_model(surroundings, capsys):
    assert main(["doctor"]) == 2
    assert capsys.readouterr().err == (
        "llm3: error: no model: give --model NAME. 'llm3 models' shows where models can be had.\n"
    )


def test_the_doctor_examines_any_backend(surroundings, capsys, tmp_path):
    replies = tmp_path / "replies.json"
    replies.write_text(json.dumps([REPLY]))
    assert main(["doctor", "--llm", f"scripted:{replies}"]) == 0
    assert capsys.readouterr().out == f"it answers with {len(REPLY)} characters\n"
