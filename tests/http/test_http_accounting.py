"""Every request that a server counts is an answer, a retry or a step-down; and the record tells which."""

from __future__ import annotations

import pytest
from hypothesis import HealthCheck, example, given, settings
from hypothesis import strategies as st
from model_server import STRUCTURED, answer, broken_off, garbage, hung_up, refusal, silence

from llm3.errors import BackendError
from llm3.types import Stats

SCRIPT = {
    "answer": answer(),
    "no JSON": answer(b"<html>"),
    "error with 200": answer({"error": "overloaded"}),
    "no format": refusal(400, "response_format is not supported"),
    "no temperature": refusal(422, "temperature is not supported"),
    "no limit": refusal(400, "max_tokens is not supported, use max_completion_tokens"),
    "bad request": refusal(400, "no"),
    "bad key": refusal(401, "no"),
    "busy": refusal(429, "busy"),
    "quota": refusal(429, "quota", Retry_After="100000"),
    "out of order": refusal(500, "no"),
    "redirect": answer(b"", 302, {"Location": "http://127.0.0.1:9/"}),
    "broken off": broken_off,
    "hung up": hung_up,
    "garbage": garbage,
}


@settings(max_examples=60, deadline=None, suppress_health_check=[HealthCheck.function_scoped_fixture])
@given(script=st.lists(st.sampled_from(sorted(SCRIPT)), max_size=12), attempts=st.integers(1, 4))
@example(["no format", "hung up", "no temperature", "busy", "no limit", "no format", "answer"], 4)
def test_the_servers_count_is_completions_and_retries_and_step_downs(connect, server, script, attempts):
    server.received.clear()
    server.script = (*(SCRIPT[name] for name in script), answer())
    backend = connect(temperature=0.5, max_reply_tokens=9, max_attempts=attempts)
    completions, spent = 0, Stats()
    for _ in range(4):
        try:
            read = backend.complete(STRUCTURED)
        except BackendError as error:
            spent += Stats(retries=error.retries, step_downs=error.step_downs)
        else:
            completions += 1
            spent += read.stats
            assert len(read.notes) == read.stats.retries + read.stats.step_downs
    assert len(server.received) == completions + spent.retries + spent.step_downs
    assert spent.step_downs <= 4


def test_a_request_without_an_answer_counts_too(connect, server):
    server.script = (silence,)
    with pytest.raises(BackendError) as caught:
        connect(max_attempts=2, read_timeout=0.1).complete(STRUCTURED)
    assert (caught.value.retries, caught.value.step_downs, len(server.received)) == (2, 0, 2)


def test_every_retry_is_a_line_of_the_answers_notes(complete):
    script = (refusal(429, Retry_After="7"), refusal(503, Retry_After="2"), hung_up, answer())
    notes = complete(*script).notes
    assert notes[:2] == ("status 429; asked again after 7 s", "status 503; asked again after 2 s")
    assert notes[2].startswith("the answer broke off; asked again after ")
    assert len(notes) == 3


def test_a_call_that_fails_tells_what_it_cost(connect, server):
    server.script = (refusal(400, "json_schema"), refusal(500), refusal(401))
    with pytest.raises(BackendError) as caught:
        connect().complete(STRUCTURED)
    assert (caught.value.retries, caught.value.step_downs) == (2, 1)
