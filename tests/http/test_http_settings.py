"""Where the settings come from, and which values are refused."""

from __future__ import annotations

import re

import pytest
from hypothesis import given
from hypothesis import strategies as st

from llm3.errors import UsageError
from llm3.interfaces import BackendSettings
from llm3_http import plugin
from llm3_http.address import checked_address, same_address
from llm3_http.backend import HttpBackend
from llm3_http.presets import Preset, known_presets
from llm3_http.settings import HttpSettings, settings_from

ASKED = BackendSettings(model="m")
OPENAI = "https://api.openai.com/v1"
LOCAL = "http://127.0.0.1:9/v1"


def settings(asked: BackendSettings = ASKED, **environment: str) -> HttpSettings:
    return settings_from(asked, environment)


def refused(asked: BackendSettings = ASKED, **environment: str) -> str:
    with pytest.raises(UsageError) as caught:
        settings_from(asked, environment)
    return str(caught.value)


def test_the_plugin_makes_a_backend_from_the_environment(monkeypatch):
    monkeypatch.setenv("LLM3_BASE_URL", LOCAL)
    monkeypatch.setenv("LLM3_API_KEY", "sk-canary-1234")
    backend = plugin.llm3_backends()["http"](BackendSettings(model="m", temperature=0.5))
    assert isinstance(backend, HttpBackend)
    assert repr(backend).startswith(
        f"HttpBackend(HttpSettings(model='m', preset={Preset(LOCAL)!r}, key=***, temperature=0.5"
    )
    backend.close()


def test_the_defaults_are_openai_without_a_key_and_without_sampling_parameters():
    made = settings()
    assert (made.preset, bool(made.key), made.temperature) == (known_presets({})["openai"], False, None)


def test_empty_variables_are_as_good_as_none():
    made = settings(LLM3_BASE_URL=" ", LLM3_API_KEY="", OPENAI_API_KEY="sk-openai")
    assert (made.base_url, made.key.reveal()) == (OPENAI, "sk-openai")


@pytest.mark.parametrize(
    ("address", "own", "openai", "sent"),
    [
        (OPENAI, "", "sk-openai", "sk-openai"),
        (OPENAI, "sk-own", "sk-openai", "sk-own"),
        ("https://api.openai.com:443/v1/", "", "sk-openai", "sk-openai"),
        ("https://API.OpenAI.com/v1", "", "sk-openai", "sk-openai"),
        (LOCAL, "", "sk-openai", ""),
        (LOCAL, "sk-own", "sk-openai", "sk-own"),
        ("http://api.openai.com/v1", "", "sk-openai", ""),
        ("https://api.openai.com:8443/v1", "", "sk-openai", ""),
        ("https://api.openai.com.example.org/v1", "", "sk-openai", ""),
        ("https://api.openai.com/v1/elsewhere", "", "sk-openai", ""),
        ("https://example.org/api.openai.com/v1", "", "sk-openai", ""),
        ("https://notapi.openai.com/v1", "", "sk-openai", ""),
    ],
)
def test_openais_key_goes_to_openai_alone(address, own, openai, sent):
    made = settings(LLM3_BASE_URL=address, LLM3_API_KEY=own, OPENAI_API_KEY=openai)
    assert made.key.reveal() == sent


@given(st.text())
def test_openais_key_goes_to_no_address_that_could_be_made_up(text):
    try:
        made = settings(LLM3_BASE_URL=text, OPENAI_API_KEY="sk-openai")
    except UsageError:
        return
    assert made.key.reveal() == ("sk-openai" if same_address(made.base_url, OPENAI) else "")


@given(st.text() | st.from_regex(r"(https?|ftp)://[\w:@./?#\\\[\] -]*"))
def test_an_address_is_usable_or_refused_in_one_line(text):
    try:
        shown = checked_address(text, "LLM3_BASE_URL")
    except UsageError as error:
        shown = str(error)
    else:
        assert re.match("https?://", shown, re.IGNORECASE)
        assert checked_address(shown, "LLM3_BASE_URL") == shown
    assert shown.isprintable()


SCHEME = "but must be an http:// or https:// address, such as http://127.0.0.1:11434/v1"
USER = "but must hold no user name and no password: give the key in LLM3_API_KEY"
QUERY = "but must have no query and no fragment: give the key in LLM3_API_KEY"


@pytest.mark.parametrize(
    ("address", "shown", "demand"),
    [
        ("127.0.0.1:11434/v1", "127.0.0.1:11434/v1", SCHEME),
        ("localhost", "localhost", SCHEME),
        ("ftp://host/v1", "ftp://host/v1", SCHEME),
        ("http://", "http://", SCHEME),
        ("http://host:99999/v1", "http://host:99999/v1", SCHEME),
        ("http://[::1/v1", "http://[::1/v1", SCHEME),
        ("https://evil.example\\.api.openai.com/v1", "https://evil.example\\\\.api.openai.com/v1", SCHEME),
        ("http://ho\nst/v1", "http://ho\\nst/v1", SCHEME),
        ("http://hóst/v1", "http://hóst/v1", SCHEME),
        ("https://me:canary@host/v1", "https://***@host/v1", USER),
        ("https://me:can@ary@host/v1", "https://***@host/v1", USER),
        ("https://me:can/ary@host/v1", "https://***@host/v1", SCHEME),
        ("me:canary@host/v1", "***@host/v1", SCHEME),
        ("https://host/v1?key=canary", "https://host/v1?***", QUERY),
        ("https://host/v1#canary", "https://host/v1#***", QUERY),
    ],
)
def test_a_malformed_address_is_named_without_its_secrets(address, shown, demand):
    sentence = refused(LLM3_BASE_URL=address)
    assert sentence == f"LLM3_BASE_URL is '{shown}', {demand}"
    assert "canary" not in sentence


@pytest.mark.parametrize("model", [None, "", "  "])
def test_a_model_must_be_named(model):
    sentence = "the backend 'http' needs the name of a model: give --model NAME"
    assert refused(BackendSettings(model=model)) == sentence


def test_the_backend_takes_no_argument():
    assert refused(BackendSettings(model="m", argument="//me:canary@host")) == (
        "the backend 'http' takes no argument, but was given '***@host': set LLM3_BASE_URL to the server's address"
    )


@pytest.mark.parametrize("temperature", [-0.1, float("nan"), float("inf")])
def test_a_temperature_is_a_number_of_at_least_zero(temperature):
    sentence = f"--temperature must be a number of at least 0, not {temperature}"
    assert refused(BackendSettings(model="m", temperature=temperature)) == sentence


@pytest.mark.parametrize("limit", ["connect_timeout", "read_timeout", "max_attempts", "deadline", "max_body"])
@pytest.mark.parametrize("value", [0, -1, float("nan")])
def test_limits_are_positive(limit, value):
    with pytest.raises(UsageError) as caught:
        HttpSettings("m", Preset(LOCAL), **{limit: value})
    assert str(caught.value) == f"{limit} must be a positive number, not {value}"


@pytest.mark.parametrize("variable", ["LLM3_API_KEY", "OPENAI_API_KEY"])
@pytest.mark.parametrize("key", ["sk canary", "sk-canary\nX-Other: 1", "sk-cänary", "sk-canary\x00"])
def test_a_key_that_no_header_can_hold_is_refused_without_showing_it(variable, key):
    assert refused(**{variable: key}) == (
        f"{variable} holds a space or a character that is not printable ASCII: set it to the key alone"
    )


def test_space_around_a_key_does_no_harm():
    assert settings(LLM3_API_KEY=" sk-own\n").key.reveal() == "sk-own"
