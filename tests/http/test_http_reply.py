"""How an answer is read."""

from __future__ import annotations

import json

import pytest
from hypothesis import given
from hypothesis import strategies as st
from model_server import answer, completion

from llm3.errors import BackendError
from llm3_http.reply import read_completion, server_message, without_reasoning
from llm3_http.settings import HttpSettings
from llm3_http.wording import LONGEST, cut, one_line

SETTINGS = HttpSettings("m", "http://host/v1")
JSON = st.recursive(
    st.none() | st.booleans() | st.integers() | st.floats() | st.text(),
    lambda inner: (
        st.lists(inner, max_size=3)
        | st.dictionaries(
            st.sampled_from(
                ["choices", "message", "content", "error", "usage", "model", "refusal", "prompt_tokens", "text"]
            ),
            inner,
            max_size=4,
        )
    ),
    max_leaves=12,
)


@given(JSON.map(lambda value: json.dumps(value).encode()) | st.binary())
def test_any_body_gives_a_completion_or_one_line(body):
    try:
        read = read_completion(body, SETTINGS)
    except BackendError as error:
        sentence = str(error)
    else:
        sentence = read.model + read.finish_reason
        assert read.text.encode() is not None
        assert min(read.stats.prompt_tokens, read.stats.completion_tokens) >= 0
    assert sentence.isprintable()


@given(JSON, JSON, JSON, JSON)
def test_any_content_of_a_message_is_read(content, reason, usage, model):
    body = completion(content, usage=usage, model=model)
    body["choices"][0]["finish_reason"] = reason
    read = read_completion(json.dumps(body).encode(), SETTINGS)
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


def test_reasoning_beside_the_answer_is_left_out(complete):
    body = completion("a plan")
    body["choices"][0]["message"]["reasoning_content"] = "hm"
    assert complete(answer(body)).text == "a plan"


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
NO_CHOICES = "sent no choices with a message: check LLM3_BASE_URL"


@pytest.mark.parametrize(
    ("body", "says"),
    [
        (b"<html>\n <b>Welcome</b>\x1b[31m</html>", f"{NO_JSON}; it says: <html> <b>Welcome</b>[31m</html>"),
        (b"", NO_JSON),
        (b"\xff\xfe\xff", f"{NO_JSON}; it says: \ufffd\ufffd\ufffd"),
        (b"[1]", f"{NO_JSON}; it says: [1]"),
        (b"[" * 100_000, f"{NO_JSON}; it says: {'[' * 199}…"),
        (b'{"n": ' + b"1" * 5000 + b"}", f'{NO_JSON}; it says: {{"n": {"1" * 193}…'),
        (b'{"id": 1}', f'{NO_CHOICES}; it says: {{"id": 1}}'),
        (b'{"choices": []}', f'{NO_CHOICES}; it says: {{"choices": []}}'),
        (b'{"choices": [{"text": "x"}]}', f'{NO_CHOICES}; it says: {{"choices": [{{"text": "x"}}]}}'),
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
        "no",
    ],
)
def test_servers_word_their_errors_in_many_forms(body):
    assert server_message(json.dumps(body).encode()) == "no"


@given(st.text().filter(lambda text: "think>" not in text))
def test_a_text_without_reasoning_stays_as_it_is(text):
    assert without_reasoning(text) == text
    assert without_reasoning(f"<think>{text}</think>{text}") == text.lstrip()


@given(st.text())
def test_a_quotation_is_one_printable_line_and_short(text):
    line = cut(one_line(text))
    assert line.isprintable()
    assert len(line) <= LONGEST
    assert one_line(line) == line
