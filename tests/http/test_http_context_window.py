"""A prompt that does not fit: said by the server, or found out."""

from __future__ import annotations

from dataclasses import replace

import pytest
from hypothesis import given
from hypothesis import strategies as st
from model_server import QUESTION, answer, completion, refusal

from llm3.types import Message
from llm3_http.context_window import least_tokens

LONG = replace(QUESTION, messages=(Message("system", "You plan."), Message("user", "box " * 5000)))
CUTS = {"cuts_long_prompts": True}


def read(tokens: object) -> dict[str, object]:
    return completion(usage={"prompt_tokens": tokens, "completion_tokens": 1})


def test_a_prompt_that_a_server_cut_off_in_silence_is_no_question(failure, server):
    assert failure(answer(read(4096)), question=LONG, preset=CUTS) == (
        f"the server at {server.url} read 4096 tokens of a prompt that has 5002 at least, and so cut it off: "
        "let it have a larger context (OLLAMA_CONTEXT_LENGTH for Ollama), or give a smaller --trace-size"
    )
    assert len(server.received) == 1


@pytest.mark.parametrize("tokens", [5002, 6500, 100_000, 0, None])
def test_a_prompt_that_can_have_been_read_as_a_whole_passes(complete, tokens):
    assert complete(answer(read(tokens)), question=LONG, preset=CUTS).text == "a plan"


def test_other_servers_are_believed(complete):
    assert complete(answer(read(4096)), question=LONG).text == "a plan"


@given(st.lists(st.text(), max_size=4), st.lists(st.text(), max_size=4))
def test_tokens_add_up_over_messages_and_are_no_more_than_characters(one, two):
    first, second = ([Message("user", text) for text in texts] for texts in (one, two))
    assert least_tokens(first + second) == least_tokens(first) + least_tokens(second)
    assert least_tokens(first) <= sum(map(len, one))


@given(st.integers(0, 50))
def test_words_and_numbers_are_tokens_whatever_stands_between_them(number):
    for word, between in (("box", " "), ("12", ", "), ("don't", "\n\n"), ("größer", " – ")):
        assert least_tokens([Message("user", between.join([word] * number))]) == number


@pytest.mark.parametrize(
    ("status", "message"),
    [
        (400, "This model's maximum context length is 4096 tokens."),
        (400, "the request exceeds the available context size. try increasing the context size"),
        (400, "prompt is too long: 213456 tokens > 200000 maximum"),
        (413, "too many input tokens"),
        (422, "context window exceeded"),
    ],
)
def test_a_server_that_says_so_is_quoted(failure, server, status, message):
    assert failure(refusal(status, message)) == (
        f"the prompt does not fit into the context of model 'asked-model' at {server.url} ({status}): "
        "give a smaller --trace-size or another --model, or let the server have a larger context; "
        f"it says: {message}"
    )
    assert len(server.received) == 1
