"""Each way in which there is no answer ends in one sentence that says what to do."""

from __future__ import annotations

import re
import socket
import threading

import pytest
import requests
from model_server import (
    answer,
    bad_compression,
    broken_chunk,
    broken_off,
    crumbs,
    drip,
    flood,
    garbage,
    hung_up,
    refusal,
    silence,
    stalled,
)

from llm3.errors import BackendError
from llm3_http.presets import known_presets
from llm3_http.secret import Secret
from llm3_http.settings import HttpSettings
from llm3_http.statuses import check_status
from llm3_http.transport import Reply

OPENAI = known_presets({})["openai"]


@pytest.fixture
def nobody() -> str:
    """An address where nothing listens."""
    with socket.create_server(("127.0.0.1", 0)) as taken:
        port = taken.getsockname()[1]
    return f"http://127.0.0.1:{port}/v1"


def test_no_server(failure, time, nobody):
    assert failure(base_url=nobody) == f"no server answers at {nobody}: start it, or set LLM3_BASE_URL"
    assert len(time.naps) == 4


def test_no_such_host(failure, monkeypatch):
    def unknown(*_: object) -> None:
        raise socket.gaierror(socket.EAI_NONAME, "Name or service not known")

    monkeypatch.setattr(socket, "getaddrinfo", unknown)
    url = "http://no-such-host.invalid/v1"
    assert failure(base_url=url) == f"no server answers at {url}: start it, or set LLM3_BASE_URL"


def test_a_connection_that_does_not_come_about(failure, server):
    class Unreachable(requests.Session):
        def post(self, *_: object, timeout: tuple[float, float], **__: object) -> requests.Response:
            assert timeout == (7.0, 60.0)
            raise requests.ConnectTimeout

    limits = {"connect_timeout": 7.0, "read_timeout": 60.0}
    assert failure(session_factory=Unreachable, **limits) == (
        f"no server answers at {server.url} within 7 s: start it, or set LLM3_BASE_URL"
    )


def test_no_proxy_answers(failure, nobody, monkeypatch):
    monkeypatch.setenv("HTTP_PROXY", nobody)
    assert failure(base_url="http://models.invalid/v1") == (
        "no proxy answers on the way to http://models.invalid/v1: check HTTP_PROXY, HTTPS_PROXY and NO_PROXY"
    )


def test_no_tls(failure, server):
    url = server.url.replace("http://", "https://")
    sentence = failure(base_url=url)
    start = f"no TLS connection to {url}: check LLM3_BASE_URL and the server's certificate; it says: "
    assert re.fullmatch(re.escape(start) + ".{1,200}", sentence)
    assert server.received == []


@pytest.mark.parametrize(
    ("url", "kind"),
    [("http://" + "a" * 70 + ".example/v1", "LocationParseError"), ("http://*/v1", "InvalidURL")],
)
def test_an_address_that_no_request_can_be_made_to(failure, url, kind):
    assert failure(base_url=url) == (
        f"no request can be made to {url} ({kind}): check LLM3_BASE_URL and the settings of proxies and certificates"
    )


def test_certificates_that_are_not_there(failure, monkeypatch):
    monkeypatch.setenv("REQUESTS_CA_BUNDLE", "/no/such/file")
    assert failure(base_url="https://models.invalid/v1") == (
        "no request can be made to https://models.invalid/v1 (OSError): "
        "check LLM3_BASE_URL and the settings of proxies and certificates"
    )


def test_a_server_that_needs_a_key_is_not_even_asked_without_one(failure, time):
    preset = {"needs_key": True, "key_variables": ("OPENAI_API_KEY",)}
    assert failure(base_url=OPENAI.base_url, preset=preset) == (
        "https://api.openai.com/v1 needs a key: set LLM3_API_KEY or OPENAI_API_KEY, or LLM3_BASE_URL for another server"
    )
    assert time.naps == []


@pytest.mark.parametrize("trouble", [broken_off, broken_chunk, hung_up, garbage, bad_compression])
def test_an_answer_that_breaks_off(failure, server, trouble):
    assert failure(trouble, max_attempts=3) == (
        f"the server at {server.url} broke off its answer: try again later, or look into the server's log"
    )
    assert len(server.received) == 3


LATE = "try again later, or give another --model"


def test_a_server_that_stays_silent(failure, server):
    assert failure(silence, max_attempts=2, read_timeout=0.1) == (
        f"the server at {server.url} did not answer in full within 0.1 s: {LATE}"
    )
    assert len(server.received) == 2


def test_a_server_that_stops_in_the_middle(failure, server):
    assert failure(stalled, max_attempts=2, read_timeout=0.1) == (
        f"the server at {server.url} did not answer in full within 0.1 s: {LATE}"
    )
    assert len(server.received) == 2


def test_a_server_that_drips_has_the_same_time_as_any_other(failure, server, time):
    time.step = 1.0  # a second between any two pieces, and no pause near the limit
    assert failure(drip, max_attempts=1, read_timeout=20.0) == (
        f"the server at {server.url} did not answer in full within 20 s: {LATE}"
    )


def test_a_request_has_no_more_time_than_the_call(failure, server, time):
    time.step = 1.0
    assert failure(drip, max_attempts=1, read_timeout=500.0, deadline=10.0) == (
        f"the server at {server.url} did not answer in full within 9 s: {LATE}"
    )


def test_an_answer_without_end_is_refused_while_it_arrives(failure, server):
    assert failure(flood) == (
        f"the server at {server.url} sent more than 4000000 bytes: check LLM3_BASE_URL and --model"
    )
    assert len(server.received) == 1


@pytest.mark.parametrize("status", [301, 302, 303, 307, 308])
def test_a_redirect_is_not_followed(failure, server, status):
    target = f"{server.url}/elsewhere"
    moved = answer(b"", status, {"Location": f"{target}?token=canary"})
    assert failure(moved, answer(), key="sk-something") == (
        f"the server at {server.url} redirects to {target}?*** ({status}), which is not followed, "
        "as the key would go with it: set LLM3_BASE_URL to the right address"
    )
    assert len(server.received) == 1


def test_a_redirect_to_nowhere(failure, server):
    assert failure(answer(b"", 300)) == (
        f"the server at {server.url} redirects to nowhere (300), which is not followed, "
        "as the key would go with it: set LLM3_BASE_URL to the right address"
    )


@pytest.mark.parametrize(
    ("status", "key", "says"),
    [
        (400, "", "refuses the request (400): check --model and --temperature; it says: because"),
        (422, "", "refuses the request (422): check --model and --temperature; it says: because"),
        (400, "sk-something", "refuses the request (400): check --model and --temperature; it says: because"),
        (401, "", "asks for a key (401): set LLM3_API_KEY; it says: because"),
        (401, "sk-something", "refuses the key (401): set LLM3_API_KEY; it says: because"),
        (403, "sk-something", "refuses the key (403): set LLM3_API_KEY; it says: because"),
        (
            404,
            "",
            "has no model 'asked-model', or is no such API (404): give another --model, or set LLM3_BASE_URL; "
            "it says: because",
        ),
        (429, "", "answers 429 after 5 tries: try again later, or give another --model; it says: because"),
        (500, "", "answers 500 after 5 tries: try again later, or give another --model; it says: because"),
    ],
)
def test_a_status_says_what_to_set(failure, server, status, key, says):
    assert failure(refusal(status, "because"), key=key) == f"the server at {server.url} {says}"


def test_openais_refusal_names_both_variables():
    with pytest.raises(BackendError) as caught:
        check_status(Reply(401, {}, b"because"), HttpSettings("m", OPENAI, Secret("sk-x")), attempt=1, now=0.0)
    assert str(caught.value) == (
        f"the server at {OPENAI.base_url} refuses the key (401): set LLM3_API_KEY or OPENAI_API_KEY; it says: because"
    )


@pytest.mark.parametrize("body", [b"", b"\n \x00", b'""'])
def test_a_server_that_does_not_say_why_is_not_quoted(failure, server, body):
    sentence = failure(answer(body, 400))
    assert sentence.startswith(f"the server at {server.url} refuses the request (400): check --model and --temperature")


def test_a_long_or_wild_explanation_is_cut_to_a_line(failure, server):
    assert failure(refusal(400, "no\r\n\x1b]0;title\x07\u202e" + "x" * 10_000)) == (
        f"the server at {server.url} refuses the request (400): check --model and --temperature; "
        f"it says: no ]0;title{'x' * 188}…"
    )


def test_a_refusal_whose_explanation_breaks_off_is_still_a_refusal(failure, server):
    def half(handler):
        handler.send_response(401)
        handler.send_header("Content-Length", "1000")
        handler.end_headers()
        handler.wfile.write(b"wrong key, and")

    assert failure(half, key="sk-something") == (
        f"the server at {server.url} refuses the key (401): set LLM3_API_KEY; it says: wrong key, and"
    )
    assert len(server.received) == 1


def test_a_refusal_whose_explanation_has_no_end_is_still_a_refusal(failure, server):
    sent = []

    def endless(handler):
        handler.send_response(403)
        handler.end_headers()
        for _ in range(500):
            handler.wfile.write(b"no " * 10_000)
            sent.append(1)

    assert failure(endless).startswith(
        f"the server at {server.url} asks for a key (403): set LLM3_API_KEY; it says: no"
    )
    assert len(server.received) == 1
    assert len(sent) < 500


CHUNKED = b"HTTP/1.1 200 OK\r\nTransfer-Encoding: chunked\r\n\r\n"


@pytest.mark.parametrize(
    ("beginning", "crumb"),
    [
        (b"HTTP/1.1 200 OK\r\nX-Slow: ", b"x"),
        (b"", b"HTTP/1.1 100 Continue\r\n\r\n"),
        (CHUNKED, b"0"),
        (CHUNKED + b"2\r\n{}\r\n0\r\n", b"X-Trailer: x\r\n"),
        (b"HTTP/1.1 503 Busy\r\nContent-Length: 100000\r\n\r\n", b"x"),
    ],
    ids=["in a header", "before the answer", "in a chunk's length", "after the body", "in an error"],
)
def test_a_server_that_goes_on_with_crumbs_is_cut_off(failure, server, beginning, crumb):
    threads = threading.active_count()
    assert failure(crumbs(beginning, crumb), read_timeout=0.2, max_attempts=1) == (
        f"the server at {server.url} did not answer in full within 0.2 s: try again later, or give another --model"
    )
    assert threading.active_count() <= threads + 1  # the server's own, which has not noticed yet
