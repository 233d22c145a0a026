"""When a request is made again, and after which wait."""

from __future__ import annotations

import math
from dataclasses import replace
from email.utils import formatdate

import pytest
from hypothesis import given
from hypothesis import strategies as st
from model_server import QUESTION, answer, broken_off, hung_up, refusal, silence

from llm3.errors import BackendError
from llm3_http.presets import Preset
from llm3_http.retry import backoff, read_retry_after
from llm3_http.settings import HttpSettings

MAY_PASS = [408, 409, 425, 429, 500, 502, 503, 504, 529]
WILL_NOT_PASS = [400, 401, 402, 403, 404, 405, 413, 422, 451]


@pytest.mark.parametrize("status", MAY_PASS)
def test_what_may_pass_is_tried_again(complete, server, time, status):
    read = complete(refusal(status), refusal(status), answer())
    assert (read.text, read.stats.retries) == ("a plan", 2)
    assert len(server.received) == 3
    assert len(time.naps) == 2


@pytest.mark.parametrize("trouble", [broken_off, hung_up])
def test_a_lost_connection_is_tried_again(complete, server, trouble):
    assert complete(trouble, answer()).stats.retries == 1
    assert len(server.received) == 2


@pytest.mark.parametrize("status", WILL_NOT_PASS)
def test_what_will_not_pass_is_not_tried_again(failure, server, time, status):
    failure(refusal(status))
    assert len(server.received) == 1
    assert time.naps == []


@pytest.mark.parametrize("attempts", [1, 2, 5])
def test_attempts_are_bounded(failure, server, attempts):
    tries = "1 try" if attempts == 1 else f"{attempts} tries"
    assert failure(refusal(503, "full"), max_attempts=attempts) == (
        f"the server at {server.url} answers 503 after {tries}: try again later, or give another --model; it says: full"
    )
    assert len(server.received) == attempts


def test_the_same_request_is_sent_again(complete, server):
    complete(refusal(500), answer())
    assert server.received[0] == server.received[1]


@pytest.mark.parametrize(
    ("status", "attempts", "allowed", "out_of_time"),
    [(503, 5, 0.1, True), (503, 1, 0.1, False), (401, 5, 0.1, False), (503, 5, math.inf, False)],
)
def test_a_call_that_the_runs_time_ended_says_so(connect, server, status, attempts, allowed, out_of_time):
    server.script = (refusal(status),)
    with pytest.raises(BackendError) as caught:
        connect(max_attempts=attempts).complete(replace(QUESTION, seconds=allowed))
    assert caught.value.out_of_time is out_of_time


def test_no_wait_is_begun_that_would_end_after_the_deadline(failure, server, time):
    failure(refusal(503), max_attempts=1000, deadline=100.0, longest_wait=8.0)
    assert sum(time.naps) < 100
    assert sum(time.naps) > 100 - 8
    assert len(server.received) == len(time.naps) + 1


@pytest.mark.parametrize("allowed", [10.0, 100.0])
def test_a_call_takes_no_longer_than_its_request_allows(connect, server, time, allowed):
    server.script = (refusal(503),)
    began = time.now
    with pytest.raises(BackendError) as caught:
        connect(max_attempts=1000, deadline=900.0, longest_wait=4.0).complete(replace(QUESTION, seconds=allowed))
    assert allowed - 4 < time.now - began < allowed
    assert caught.value.retries == len(server.received)


def test_a_request_that_allows_no_time_is_not_waited_for(connect, server, time):
    server.script = (silence,)
    with pytest.raises(BackendError) as caught:
        connect().complete(replace(QUESTION, seconds=-1.0))
    assert (caught.value.retries, time.naps) == (1, [])


def test_waits_double_up_to_a_limit_with_jitter(failure, time):
    failure(refusal(503), max_attempts=8)
    whole = [1, 2, 4, 8, 16, 30, 30]
    assert all(most / 2 <= nap <= most for nap, most in zip(time.naps, whole, strict=True))
    assert len({nap / most for nap, most in zip(time.naps, whole, strict=True)}) == 7


@given(st.integers(1, 10_000), st.floats(0, 1, exclude_max=True))
def test_a_wait_is_finite_positive_and_bounded(attempt, draw):
    settings = HttpSettings("m", Preset("http://host/v1"))
    assert 0 < backoff(settings, attempt, draw) <= settings.longest_wait
    assert backoff(settings, attempt, draw) <= 2 * backoff(settings, attempt + 1, draw)


@pytest.mark.parametrize("status", [429, 503])
def test_retry_after_in_seconds_is_honoured(complete, time, status):
    complete(refusal(status, retry_after="7"), answer())
    assert time.naps == [7.0]


def test_retry_after_as_a_date_is_honoured(complete, time):
    complete(refusal(429, Retry_After=formatdate(time.now + 42, usegmt=True)), answer())
    assert time.naps == [42.0]


@pytest.mark.parametrize("header", ["0", "soon", "-5", "nan", "", formatdate(0, usegmt=True)])
def test_a_retry_after_that_says_nothing_leaves_the_usual_wait(complete, time, header):
    complete(refusal(429, Retry_After=header), answer())
    assert 0.5 <= time.naps[0] <= 1.0


@pytest.mark.parametrize(
    ("header", "said"),
    [("3600", "3600 s"), ("9" * 400, "1000000000 s"), (formatdate(5000, usegmt=True), "4000 s")],
)
def test_a_retry_after_beyond_the_deadline_ends_the_call_at_once(failure, server, time, header, said):
    sentence = failure(refusal(429, "quota", Retry_After=header), deadline=60.0)
    assert sentence == (
        f"the server at {server.url} answers 429 after 1 try: try again later, or give another --model; "
        f"it says: quota; it asks to wait {said}, but this call may only take another 60 s"
    )
    assert len(server.received) == 1
    assert time.naps == []


@given(st.none() | st.text() | st.from_regex(r"[0-9]+(\.[0-9]+)?") | st.from_regex(r"\w{3}, \d+ \w{3} \d+ [\d:]+ \w+"))
def test_any_retry_after_reads_as_a_bounded_time_or_nothing(header):
    asked = read_retry_after(header, 0.0)
    assert asked is None or 0 <= asked <= 1e9


@given(st.integers(0, 10**9))
def test_a_date_and_its_seconds_are_the_same(delay):
    now = 1_700_000_000
    by_date = read_retry_after(formatdate(now + delay, usegmt=True), now)
    assert by_date is not None
    assert math.isclose(by_date, read_retry_after(str(delay), now) or 0.0)


def test_an_interrupt_is_not_a_reason_to_try_again(connect, server):
    def interrupted(_: float) -> None:
        raise KeyboardInterrupt

    server.script = (refusal(503),)
    with pytest.raises(KeyboardInterrupt):
        connect(sleep=interrupted).complete(QUESTION)
    assert len(server.received) == 1
