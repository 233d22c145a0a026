"""What a server refuses is given up, step by step, told, and remembered."""

from __future__ import annotations

import pytest
from hypothesis import given
from hypothesis import strategies as st
from model_server import QUESTION, SCHEMA, STRUCTURED, answer, refusal

from llm3.errors import BackendError
from llm3_http.features import Features, features_of, fewer_features
from llm3_http.presets import Preset, known_presets

FULL = features_of(Preset("http://host/v1"), limit=True, temperature=True)
FEATURES = st.builds(
    features_of,
    st.sampled_from([*known_presets({}).values(), Preset("http://host/v1")]),
    limit=st.booleans(),
    temperature=st.booleans(),
)
WORDS = (
    "response_format json_schema schema grammar temperature max_tokens max_completion_tokens unsupported maximum "
    "context length is not allowed"
)
MESSAGES = st.lists(st.sampled_from(WORDS.split()), max_size=6).map(" ".join) | st.text()


def size(features: Features) -> int:
    return len(features.reply_formats) + len(features.limit_fields) + features.temperature


@given(FEATURES, st.sampled_from([400, 422]) | st.integers(100, 599), MESSAGES)
def test_every_step_gives_up_one_thing_so_that_steps_come_to_an_end(features, status, message):
    fewer = fewer_features(features, status, message)
    if fewer is not None:
        assert status in (400, 422)
        assert size(fewer) == size(features) - 1
        assert fewer.reply_formats
        assert fewer.limit_fields


@pytest.mark.parametrize(
    ("message", "given_up"),
    [
        # as servers word it
        ("'response_format.type' must be 'json_schema' or 'text'", "reply_formats"),
        ("Invalid schema for response_format 'reply': In context=(), 'pattern' is not permitted", "reply_formats"),
        ("Grammar error: Failed to convert the grammar from GBNF to Lark", "reply_formats"),
        ('Invalid JSON payload received. Unknown name "pattern": Cannot find field.', "reply_formats"),
        ("Failed to generate JSON. Please adjust your prompt.", None),
        ("model 'qwen2.5-json-7b' does not exist", None),
        ("We could not parse the JSON body of your request.", None),
        ("Invalid temperature: 5", None),
        ("temperature should be in [0, 2]", None),
        ("temperature must not exceed 2", None),
        ("max_tokens cannot exceed 4096", None),
        ("max_tokens must be a positive integer", None),
        ("output_config.format: Extra inputs are not permitted", "reply_formats"),
        ("This model does not support structured outputs", "reply_formats"),
        ("Unsupported value: 'temperature' does not support 0.16 with this model. Only the default (1)", "temperature"),
        ("`temperature` is deprecated for this model.", "temperature"),
        ("Invalid 'temperature': decimal above maximum value. Expected a value <= 2, but got 5", None),
        ("Unsupported parameter: 'max_tokens' is not supported. Use 'max_completion_tokens' instead.", "limit_fields"),
        ("max_tokens is too large: 100000. This model supports at most 16384 completion tokens", None),
        ("This model's maximum context length is 4096 tokens, of which max_tokens asks for 4000", None),
        ("request (9000 tokens) exceeds the available context size (8192 tokens)", None),
        ("The input token count (1200000) exceeds the maximum number of tokens allowed (1048576).", None),
        ("Input tokens exceed the configured limit of 272000 tokens: your schema and messages are too long", None),
        ("prompt is too long: 213456 tokens > 200000 maximum", None),
        ("model not found", None),
        ("", None),
    ],
)
def test_servers_word_what_they_refuse_in_many_ways(message, given_up):
    fewer = fewer_features(FULL, 400, message)
    changed = [
        name
        for name in ("reply_formats", "limit_fields", "temperature")
        if fewer and vars(fewer)[name] != vars(FULL)[name]
    ]
    assert changed == ([given_up] if given_up else [])


@pytest.mark.parametrize("status", [401, 403, 404, 429, 500])
def test_only_a_bad_request_is_about_features(status):
    assert fewer_features(FULL, status, "response_format temperature max_tokens") is None


def test_what_is_not_sent_cannot_be_refused():
    bare = features_of(Preset("http://host/v1", reply_formats=("text",)), limit=False, temperature=False)
    assert fewer_features(bare, 400, "response_format temperature max_tokens") is None


SCHEMA_SENT = {"type": "json_schema", "json_schema": {"name": "reply", "strict": True, "schema": SCHEMA}}


def formats(server) -> list[object]:
    return [received.payload.get("response_format") for received in server.received]


def test_the_schema_is_asked_for_first_then_any_json_then_nothing(complete, server):
    no = refusal(400, "response_format is not supported")
    read = complete(no, no, answer(), question=STRUCTURED)
    assert formats(server) == [SCHEMA_SENT, {"type": "json_object"}, None]
    assert (read.text, read.stats.step_downs, read.stats.retries) == ("a plan", 2, 0)
    assert read.notes == (
        "status 400: the reply format json_schema is refused, and json_object is asked for from now on",
        "status 400: the reply format json_object is refused, and text is asked for from now on",
    )


def test_a_refusal_of_the_server_behind_the_server_is_one(complete):
    behind = '{"error": {"message": "Invalid schema for response_format"}}'
    error = {"message": "Provider returned error", "metadata": {"raw": behind, "provider_name": "x"}}
    assert complete(answer({"error": error}, 400), answer(), question=STRUCTURED).stats.step_downs == 1


def test_the_formats_of_the_preset_are_tried_and_no_others(complete, server):
    no = refusal(422, "response_format is not supported")
    complete(no, answer(), question=STRUCTURED, preset={"reply_formats": ("json_schema", "text")})
    assert formats(server) == [SCHEMA_SENT, None]


def test_what_was_refused_once_is_not_asked_for_again(connect, server):
    server.script = (refusal(400, "no json_schema"), answer())
    backend = connect()
    stats = [backend.complete(STRUCTURED).stats.step_downs for _ in range(3)]
    assert stats == [1, 0, 0]
    assert formats(server) == [SCHEMA_SENT] + [{"type": "json_object"}] * 3


def test_what_was_refused_is_remembered_when_the_call_fails(connect, server):
    server.script = (refusal(400, "no json_schema"), refusal(404), answer())
    backend = connect()
    with pytest.raises(BackendError) as caught:
        backend.complete(STRUCTURED)
    assert (caught.value.retries, caught.value.step_downs) == (1, 1)
    assert backend.complete(STRUCTURED).stats.step_downs == 0


def test_a_format_that_is_refused_at_the_last_step_is_an_error(failure, server):
    sentence = failure(refusal(400, "no json_schema"), question=STRUCTURED, preset={"reply_formats": ("json_schema",)})
    refused = "refuses the request (400): check --model and --temperature; it says: no json_schema"
    assert sentence == f"the server at {server.url} {refused}"
    assert len(server.received) == 1


def test_a_question_without_a_schema_asks_for_no_format(complete, server):
    read = complete(question=QUESTION)
    assert formats(server) == [None]
    assert read.stats.step_downs == 0


def test_a_question_without_a_schema_says_nothing_of_formats(connect, server):
    server.script = (refusal(400, "no json_schema"), answer())
    backend = connect()
    with pytest.raises(BackendError):
        backend.complete(QUESTION)
    assert backend.complete(STRUCTURED).stats.step_downs == 0
    assert formats(server) == [None, SCHEMA_SENT]


def test_a_refused_temperature_is_left_out(complete, server):
    read = complete(refusal(400, "Unsupported value: 'temperature'"), answer(), temperature=0.5)
    assert [received.payload.get("temperature") for received in server.received] == [0.5, None]
    assert read.notes == ("status 400: the temperature is refused, and left out from now on",)


@pytest.mark.parametrize(
    ("first", "second"), [("max_tokens", "max_completion_tokens"), ("max_completion_tokens", "max_tokens")]
)
def test_a_refused_limit_is_sent_under_its_other_name(complete, server, first, second):
    no = refusal(400, f"Unsupported parameter: '{first}'")
    read = complete(no, answer(), max_reply_tokens=9, preset={"limit_field": first})
    sent = [{k: v for k, v in r.payload.items() if k.startswith("max_")} for r in server.received]
    assert sent == [{first: 9}, {second: 9}]
    assert read.notes == (f"status 400: {first} is refused, and {second} is sent from now on",)
    assert read.stats.step_downs == 1


def test_all_of_it_can_be_refused_at_once(complete, server):
    refused = ("json_schema", "temperature", "json_object", "max_tokens")
    script = [refusal(400, f"{field} is not supported") for field in refused]
    read = complete(*script, answer(), question=STRUCTURED, temperature=1.0, max_reply_tokens=9)
    assert (read.stats.step_downs, len(server.received)) == (4, 5)
    assert set(server.received[-1].payload) == {"model", "messages", "max_completion_tokens"}
