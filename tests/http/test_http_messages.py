"""Anthropic's Messages API."""

from __future__ import annotations

from dataclasses import replace

import pytest
from model_server import SCHEMA, STRUCTURED, answer, anthropic_completion, refusal

from llm3.types import Completion, Context, Message, Request, Stats
from llm3_http.features import features_of
from llm3_http.messages import Messages
from llm3_http.presets import Preset, known_presets
from llm3_http.reply import read_completion
from llm3_http.settings import HttpSettings

ANTHROPIC = {"dialect": "messages", "reply_formats": ("json_schema", "text"), "max_reply_tokens": 8192}
OK = answer(anthropic_completion())


@pytest.fixture
def ask(complete):
    return lambda *script, **arguments: complete(*(script or (OK,)), preset=ANTHROPIC, **arguments)


def test_a_request_is_as_the_api_has_it(ask, server):
    ask(key="sk-ant")
    (received,) = server.received
    assert received.path == "/v1/messages"
    assert received.payload == {
        "model": "asked-model",
        "max_tokens": 8192,
        "system": "You plan.",
        "messages": [{"role": "user", "content": "Pack the red box, größer."}],
    }
    assert received.headers["x-api-key"] == "sk-ant"
    assert received.headers["anthropic-version"] == "2023-06-01"
    assert "authorization" not in received.headers


def test_what_the_user_asks_for_is_sent(ask, server):
    ask(temperature=0.5, max_reply_tokens=9)
    payload = server.received[0].payload
    assert (payload["temperature"], payload["max_tokens"]) == (0.5, 9)


def test_the_order_of_a_conversation_is_kept_and_all_that_the_system_says_comes_first():
    messages = (Message("system", "a"), Message("user", "b"), Message("assistant", "c"), Message("system", "d"))
    settings = HttpSettings("m", known_presets({})["anthropic"])
    features = replace(features_of(settings.preset, limit=True, temperature=False), structured=False)
    payload = Messages().payload(settings, features, Request(messages, Context("", (), (), ())))
    assert payload["system"] == "a\n\nd"
    assert payload["messages"] == [{"role": "user", "content": "b"}, {"role": "assistant", "content": "c"}]


def test_a_schema_goes_into_the_output_configuration_and_is_left_out_where_it_is_refused(ask, server):
    read = ask(refusal(400, "output_config.format: not supported"), OK, question=STRUCTURED)
    sent = [received.payload.get("output_config") for received in server.received]
    assert sent == [{"format": {"type": "json_schema", "schema": SCHEMA}}, None]
    assert read.stats.step_downs == 1


def test_an_answer_is_its_text_blocks_and_thinking_stands_apart(ask):
    blocks = (
        {"type": "thinking", "thinking": "hm", "signature": "x"},
        {"type": "redacted_thinking", "data": "x"},
        {"type": "text", "text": "a "},
        {"type": "text", "text": "plan"},
    )
    usage = {"input_tokens": 5, "cache_creation_input_tokens": 7, "cache_read_input_tokens": 100, "output_tokens": 3}
    assert ask(answer(anthropic_completion(*blocks, usage=usage))) == Completion(
        "a plan",
        Stats(prompt_tokens=112, cached_tokens=100, completion_tokens=3),
        model="served-model",
        finish_reason="end_turn",
        reasoning="hm",
    )


@pytest.mark.parametrize(
    ("reason", "cut_off"),
    [("max_tokens", True), ("model_context_window_exceeded", True), ("end_turn", False), ("refusal", False)],
)
def test_an_answer_that_a_limit_ended_is_known_by_its_reason(ask, reason, cut_off):
    read = ask(answer(anthropic_completion(stop_reason=reason)))
    assert read.cut_off == cut_off
    assert read.finish_reason == ("length" if cut_off else reason)


def test_overload_may_pass(ask):
    overload = answer({"type": "error", "error": {"type": "overloaded_error", "message": "Overloaded"}}, 529)
    read = ask(overload, OK)
    assert (read.text, read.stats.retries) == ("a plan", 1)


def test_an_error_of_the_api_is_quoted(failure, server):
    body = {"type": "error", "error": {"type": "authentication_error", "message": "invalid x-api-key"}}
    assert failure(answer(body, 401), preset=ANTHROPIC, key="sk-ant-wrong") == (
        f"the server at {server.url} refuses the key (401): set LLM3_API_KEY; it says: invalid x-api-key"
    )


def test_another_servers_answer_is_none(failure, server):
    assert failure(answer({"choices": []}), preset=ANTHROPIC) == (
        f'the server at {server.url} sent no answer of /messages: check LLM3_BASE_URL; it says: {{"choices": []}}'
    )


def test_an_empty_answer_is_an_answer():
    settings = HttpSettings("m", Preset("http://host/v1"))
    assert read_completion(b'{"content": []}', settings, Messages()).text == ""
