"""The key goes into the header of a request, and nowhere else."""

from __future__ import annotations

import dataclasses
import html
import json
import logging
import traceback

import pytest
from hypothesis import given
from hypothesis import strategies as st
from model_server import (
    QUESTION,
    STRUCTURED,
    answer,
    bad_compression,
    broken_off,
    completion,
    garbage,
    hung_up,
    refusal,
    silence,
)

from llm3.errors import BackendError
from llm3_http.presets import Preset
from llm3_http.secret import Secret
from llm3_http.settings import HttpSettings

CANARY = "sk-c4n4ry/with+slash=4711"


def echo_status_line(handler):
    handler.wfile.write(f"HTTP/1.1 {CANARY} {CANARY}\r\n\r\n".encode())


TROUBLES = {
    "broken off": broken_off,
    "hung up": hung_up,
    "garbage": garbage,
    "bad compression": bad_compression,
    "silence": silence,
    "status line": echo_status_line,
    "redirect": answer(b"", 302, {"Location": f"https://example.org/{CANARY}"}),
    "redirect with a query": answer(b"", 302, {"Location": f"https://{CANARY}@example.org/?key={CANARY}"}),
    "no JSON": answer(f"<p>{CANARY}</p>".encode()),
    "no choices": answer({"authorization": f"Bearer {CANARY}"}),
    "error with 200": answer({"error": {"message": CANARY}}),
    "escaped": answer(json.dumps({"error": CANARY}).replace("/", "\\/").replace("s", "\\u0073").encode(), 400),
    "control characters inside": refusal(401, f"{CANARY[:5]}\x00\u200b{CANARY[5:]}"),
    "at the cut": refusal(401, "x" * 190 + CANARY),
    **{str(status): refusal(status, f"wrong key: {CANARY}") for status in (400, 401, 403, 404, 429, 500)},
    "retry after": refusal(429, CANARY, Retry_After="100000"),
}


@pytest.mark.parametrize("trouble", TROUBLES)
def test_no_failure_shows_the_key(connect, server, caplog, trouble):
    caplog.set_level(logging.DEBUG)
    server.script = (TROUBLES[trouble],)
    backend = connect(key=CANARY, read_timeout=0.2, max_attempts=2)
    with pytest.raises(BackendError) as caught:
        backend.complete(QUESTION)
    error = caught.value
    shown = [str(error), repr(error), repr(error.args), "".join(traceback.format_exception(error)), caplog.text]
    shown += [repr(record.__dict__) for record in caplog.records] + [repr(backend), repr(vars(backend))]
    assert server.received[0].headers["authorization"] == f"Bearer {CANARY}"
    assert not [text for text in shown if CANARY[:8] in text]


@pytest.mark.parametrize("trouble", TROUBLES)
def test_no_failure_of_the_messages_api_shows_the_key(failure, server, caplog, trouble):
    caplog.set_level(logging.DEBUG)
    preset = {"dialect": "messages", "reply_formats": ("text",), "max_reply_tokens": 9}
    sentence = failure(TROUBLES[trouble], key=CANARY, preset=preset, read_timeout=0.1, max_attempts=1)
    assert server.received[0].headers["x-api-key"] == CANARY
    assert CANARY[:8] not in sentence + caplog.text


def test_no_note_shows_the_key(complete):
    script = (refusal(400, f"response_format {CANARY}"), refusal(500, CANARY), hung_up, answer())
    assert CANARY[:8] not in str(complete(*script, key=CANARY, question=STRUCTURED))


def test_no_completion_shows_the_key(complete):
    body = completion(f"you said {CANARY}", f"stop {CANARY}", model=f"m {CANARY}")
    read = complete(answer(body), key=CANARY)
    assert (read.text, read.finish_reason, read.model) == ("you said ***", "stop ***", "m ***")
    body["choices"][0]["message"]["reasoning"] = f"the key is {CANARY}"
    assert complete(answer(body), key=CANARY).reasoning == "the key is ***"


def test_a_refused_answer_does_not_send_the_key_twice(connect, server):
    other = f"{server.url}/other"
    server.script = (answer(b"", 307, {"Location": other}),)
    with pytest.raises(BackendError):
        connect(key=CANARY).complete(QUESTION)
    assert [received.path for received in server.received] == ["/v1/chat/completions"]


def test_settings_do_not_show_the_key():
    settings = HttpSettings("m", Preset("https://example.org"), Secret(CANARY))
    for shown in (repr(settings), str(settings), repr(dataclasses.asdict(settings)), f"{settings.key}"):
        assert CANARY not in shown
        assert "***" in shown


@given(st.text(), st.text())
def test_clean_text_never_holds_the_key(before, after):
    settings = HttpSettings("m", Preset("https://example.org"), Secret(CANARY))
    assert CANARY not in settings.clean(before + CANARY + after)
    assert CANARY not in settings.clean("\x00".join(before + CANARY + after))


@given(st.text(st.characters(min_codepoint=33, max_codepoint=126), min_size=8), st.text())
def test_a_redacted_text_without_the_key_is_the_text(key, text):
    assert Secret(key).redact(text) == text.replace(key, "***")


@pytest.mark.parametrize("placeholder", ["", "EMPTY", "ollama", "x"])
def test_a_placeholder_is_not_hunted_in_texts(complete, placeholder):
    assert complete(answer(completion("EMPTY x ollama")), key=placeholder).text == "EMPTY x ollama"


@given(st.data())
def test_a_key_is_hidden_also_where_some_of_its_characters_are_escaped(data):
    escapes = (
        lambda c: c,
        lambda c: c if c.isalnum() else f"\\{c}",
        lambda c: f"\\u{ord(c):04x}",
        lambda c: f"\\u{ord(c):04X}",
        lambda c: f"\\x{ord(c):02x}",
        lambda c: f"%{ord(c):02X}",
        lambda c: f"%25{ord(c):02x}",
        lambda c: f"&#{ord(c)};",
        lambda c: f"&#x{ord(c):X};",
        html.escape,
    )
    spelt = "".join(data.draw(st.sampled_from(escapes))(c) for c in CANARY)
    assert Secret(CANARY).redact(f"before {spelt} after") == "before *** after"
