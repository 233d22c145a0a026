"""How an answer is read."""

from __future__ import annotations

import json

import pytest
from hypothesis import given
from hypothesis import strategies as st
from model_server import answer, completion

from llm3.errors import BackendError
from llm3.types import Stats
from llm3_http.chat import ChatCompletions
from llm3_http.dialect import Dialect
from llm3_http.messages import Messages
from llm3_http.presets import Preset
from llm3_http.reply import read_completion, server_message
from llm3_http.retry import TryAgain
from llm3_http.settings import HttpSettings
from llm3_http.thinking import apart
from llm3_http.wording import LONGEST, cut, one_line

SETTINGS = HttpSettings("m", Preset("http://host/v1"))
FIELDS = (
    *("choices", "message", "content", "text", "type", "thinking", "error", "model", "refusal", "stop_reason", "usage"),
    *("prompt_tokens", "prompt_tokens_details", "cached_tokens", "input_tokens", "cache_read_input_tokens"),
    *("completion_tokens", "completion_tokens_details", "reasoning_tokens", "total_tokens"),
)
JSON = st.recursive(
    st.none() | st.booleans() | st.integers() | st.floats() | st.text(),
    lambda inner: st.lists(inner, max_size=3) | st.dictionaries(st.sampled_from(FIELDS), inner, max_size=4),
    max_leaves=12,
)


DIALECTS = st.sampled_from([ChatCompletions(), Messages()])


@given(JSON.map(lambda value: json.dumps(value).encode()) | st.binary(), DIALECTS)
def test_any_body_gives_a_completion_or_one_line(body: bytes, dialect: Dialect) -> None:
    try:
        read = read_completion(body, SETTINGS, dialect)
    except (BackendError, TryAgain) as error:
        sentence = str(error)
    else:
        sentence = read.model + read.finish_reason
        assert read.text.encode() is not None
        stats = read.stats
        assert 0 <= stats.cached_tokens <= stats.prompt_tokens
        assert 0 <= stats.reasoning_tokens <= stats.completion_tokens
    assert sentence.isprintable()


@given(JSON, JSON, JSON, JSON)
def test_any_content_of_a_message_is_read(content, reason, usage, model):
    body = completion(content, usage=usage, model=model)
    body["choices"][0]["finish_reason"] = reason
    read = read_completion(json.dumps(body).encode(), SETTINGS, ChatCompletions())
    assert read.text == "" or isinstance(content, (str, list))


@pytest.mark.parametrize(
    ("content", "text"),
    [
        ("a plan", "a plan"),
        (None, ""),
        ([], ""),
        ([{"type": "text", "text": "a "}, {"type": "text", "text": "plan"}], "a plan"),
        ([{"type": "thinking", "text": "hm"}, {"type": "output_text", "text": "a plan"}, {"type": "image"}], "a plan"),
        ("<think>hm</think>\n\na plan", "a plan"),
        (" \n<think>\nhm <b>\n</think>a plan", "a plan"),
        ("hm, as the template opened the block</think>a plan", "a plan"),
        ("<think>the tokens ran out", ""),
        ("a <think>no</think> plan", "a <think>no</think> plan"),
        ("half a pair: \ud800", "half a pair: ?"),
    ],
)
def test_the_answer_is_the_text_alone(complete, content, text):
    assert complete(answer(completion(content))).text == text


@pytest.mark.parametrize(
    ("content", "beside", "reasoning"),
    [
        ("a plan", {"reasoning_content": "hm"}, "hm"),
        ("a plan", {"reasoning": "hm"}, "hm"),
        ("a plan", {"reasoning_content": "hm", "reasoning": "hm"}, "hm"),
        ("a plan", {"reasoning_content": None, "reasoning": 3}, ""),
        ("<think>hm</think>a plan", {}, "hm"),
        ("hm</think>a plan", {}, "hm"),
        ("<think>hm", {}, "hm"),
        ("<think>hm</think>a plan", {"reasoning": "first"}, "first\nhm"),
        ([{"type": "thinking", "text": "hm"}, {"type": "text", "text": "a plan"}], {}, "hm"),
    ],
)
def test_what_the_model_thought_is_kept_apart(complete, content, beside, reasoning):
    body = completion(content)
    body["choices"][0]["message"] |= beside
    read = complete(answer(body))
    assert read.reasoning == reasoning
    assert "hm" not in read.text


@pytest.mark.parametrize(
    ("usage", "spent"),
    [
        (
            {
                "prompt_tokens": 100,
                "completion_tokens": 60,
                "prompt_tokens_details": {"cached_tokens": 80},
                "completion_tokens_details": {"reasoning_tokens": 50},
            },
            Stats(prompt_tokens=100, cached_tokens=80, completion_tokens=60, reasoning_tokens=50),
        ),
        # Gemini's form: what was thought is in the total alone
        (
            {"prompt_tokens": 20, "completion_tokens": 151, "total_tokens": 553},
            Stats(prompt_tokens=20, completion_tokens=533),
        ),
        ({"prompt_tokens": 5, "prompt_tokens_details": None, "completion_tokens_details": []}, Stats(prompt_tokens=5)),
        ({"prompt_tokens": 5, "prompt_tokens_details": {"cached_tokens": 9}}, Stats(prompt_tokens=5, cached_tokens=5)),
    ],
)
def test_the_parts_of_the_usage_are_told_apart(complete, usage, spent):
    assert complete(answer(completion(usage=usage))).stats == spent


def test_an_answer_that_a_limit_ended_is_known_by_its_reason(complete):
    assert complete(answer(completion("a pl", "length"))).cut_off
    assert not complete(answer()).cut_off


@pytest.mark.parametrize("reason", ["length", "content_filter"])
def test_an_empty_answer_is_an_answer_with_its_reason(complete, reason):
    read = complete(answer(completion(None, reason)))
    assert (read.text, read.finish_reason) == ("", reason)


def test_a_refusal_is_the_answer_of_a_model_that_declines(complete):
    body = completion(None)
    body["choices"][0]["message"]["refusal"] = "I cannot help with boxes."
    read = complete(answer(body))
    assert (read.text, read.finish_reason) == ("I cannot help with boxes.", "refusal")


@pytest.mark.parametrize(
    "usage",
    [None, 5, {}, {"prompt_tokens": None}, {"prompt_tokens": "many"}, {"prompt_tokens": -1}, {"prompt_tokens": True}],
)
def test_missing_or_odd_token_counts_are_zero(complete, usage):
    stats = complete(answer(completion(usage=usage))).stats
    assert (stats.prompt_tokens, stats.completion_tokens) == (0, 0)


def test_a_missing_model_and_finish_reason_are_empty(complete):
    read = complete(answer({"choices": [{"message": {"content": "a plan"}}]}))
    assert (read.text, read.model, read.finish_reason) == ("a plan", "", "")


NO_JSON = "sent no JSON object: check LLM3_BASE_URL"
NO_ANSWER = "sent no answer of /chat/completions: check LLM3_BASE_URL"


@pytest.mark.parametrize(
    ("body", "says"),
    [
        (b"<html>\n <b>Welcome</b>\x1b[31m</html>", f"{NO_JSON}; it says: <html> <b>Welcome</b>[31m</html>"),
        (b"", NO_JSON),
        (b"\xff\xfe\xff", f"{NO_JSON}; it says: \ufffd\ufffd\ufffd"),
        (b"[1]", f"{NO_JSON}; it says: [1]"),
        (b"[" * 100_000, f"{NO_JSON}; it says: {'[' * 199}…"),
        (b'{"n": ' + b"1" * 5000 + b"}", f'{NO_JSON}; it says: {{"n": {"1" * 193}…'),
        (b'{"id": 1}', f'{NO_ANSWER}; it says: {{"id": 1}}'),
        (b'{"choices": []}', f'{NO_ANSWER}; it says: {{"choices": []}}'),
        (b'{"choices": [{"text": "x"}]}', f'{NO_ANSWER}; it says: {{"choices": [{{"text": "x"}}]}}'),
        (b'{"error": {"message": "no\\nmemory"}}', "reports an error: check --model; it says: no memory"),
        (b'{"error": "overloaded", "choices": []}', "reports an error: check --model; it says: overloaded"),
    ],
)
def test_a_body_that_is_no_completion_is_refused_and_quoted(failure, server, body, says):
    assert failure(answer(body)) == f"the server at {server.url} {says}"
    assert len(server.received) == 1


def test_a_null_error_is_none(complete):
    assert complete(answer(completion(error=None))).text == "a plan"


@pytest.mark.parametrize(
    "body",
    [
        {"error": {"message": "no"}},
        {"error": "no"},
        {"message": "no"},
        {"detail": "no"},
        {"detail": [{"loc": ["body"], "msg": "no"}]},
        [{"error": {"code": 400, "message": "no"}}],
        {"error": {"metadata": {"raw": "no"}}},
        {"error": {"message": "no", "metadata": {"raw": 5}}},
        "no",
    ],
)
def test_servers_word_their_errors_in_many_forms(body):
    assert server_message(json.dumps(body).encode()) == "no"


@given(st.text().filter(lambda text: "think>" not in text))
def test_a_text_without_reasoning_stays_as_it_is(text):
    assert apart(text) == ("", text)
    assert apart(f"<think>{text}</think>{text}") == (text.strip(), text.lstrip())


@given(st.text())
def test_a_quotation_is_one_printable_line_and_short(text):
    line = cut(one_line(text))
    assert line.isprintable()
    assert len(line) <= LONGEST
    assert one_line(line) == line


@pytest.mark.parametrize(
    "body", [b'{"id": "chatcmpl-1", "choi', b'{"error": {"code": 429}}', b'{"error": {"code": 502}}']
)
def test_a_body_that_broke_off_or_holds_a_passing_error_is_asked_for_again(complete, server, body):
    read = complete(answer(body), answer())
    assert (read.text, read.stats.retries, len(server.received)) == ("a plan", 1, 2)


def test_a_body_that_always_breaks_off_is_told(failure, server):
    assert failure(answer(b'{"id": "chatcmpl-1", "choi'), max_attempts=2) == (
        f"the server at {server.url} broke off its answer: try again later, or look into the server's log"
    )
    assert len(server.received) == 2


@pytest.mark.parametrize("tokens", [10**13, 10**400, -1, True, "7", None, 1.5], ids=lambda value: str(value)[:5])
def test_a_count_that_makes_no_sense_is_none(complete, tokens):
    body = {"choices": [{"message": {"content": "a plan"}}], "usage": {"prompt_tokens": tokens}}
    assert complete(answer(json.dumps(body, default=str).encode())).stats.prompt_tokens == 0
