"""Servers as data: what ships, what a user adds, and which one a model's name means."""

from __future__ import annotations

import dataclasses
import json
from pathlib import Path

import pytest
from hypothesis import given
from hypothesis import strategies as st

from llm3.errors import InputError, UnknownName, UsageError
from llm3.interfaces import BackendSettings
from llm3.jsonio import dumps, loads
from llm3_http.address import same_address
from llm3_http.presets import Preset, known_presets
from llm3_http.settings import HttpSettings, settings_from

SHIPPED = known_presets({})
LOCAL = "http://127.0.0.1:9/v1"
OPENAI = "https://api.openai.com/v1"


def chosen(model: str, **environment: str) -> HttpSettings:
    return settings_from(BackendSettings(model=model), environment)


@pytest.fixture
def own(tmp_path: Path):
    """Writes a file of presets and answers with its path."""

    def write(presets: object) -> str:
        file = tmp_path / "presets.json"
        file.write_text(presets if isinstance(presets, str) else json.dumps(presets), encoding="utf-8")
        return str(file)

    return write


def test_these_servers_are_known():
    assert {name: preset.base_url for name, preset in SHIPPED.items()} == {
        "openai": "https://api.openai.com/v1",
        "anthropic": "https://api.anthropic.com/v1",
        "gemini": "https://generativelanguage.googleapis.com/v1beta/openai",
        "openrouter": "https://openrouter.ai/api/v1",
        "ollama": "http://127.0.0.1:11434/v1",
        "vllm": "http://127.0.0.1:8000/v1",
        "lmstudio": "http://127.0.0.1:1234/v1",
        "llamacpp": "http://127.0.0.1:8080/v1",
    }


@pytest.mark.parametrize("name", SHIPPED)
def test_a_preset_is_data(name):
    preset = SHIPPED[name]
    assert loads(dumps(preset), Preset, name) == preset
    assert preset.needs_key == preset.base_url.startswith("https://") == bool(preset.key_variables)
    assert preset.reply_formats[-1] == "text"
    assert len({preset.base_url for preset in SHIPPED.values()}) == len(SHIPPED)


def test_the_known_ways_of_servers():
    assert {name for name, preset in SHIPPED.items() if "json_object" not in preset.reply_formats} == {
        "anthropic",
        "lmstudio",
    }
    assert [name for name, preset in SHIPPED.items() if preset.dialect == "messages"] == ["anthropic"]
    assert [name for name, preset in SHIPPED.items() if preset.cuts_long_prompts] == ["ollama"]
    assert [name for name, preset in SHIPPED.items() if preset.limit_field == "max_completion_tokens"] == ["openai"]


@pytest.mark.parametrize("name", SHIPPED)
@given(model=st.text(min_size=1).filter(str.strip))
def test_what_stands_before_the_first_slash_names_the_preset(name, model):
    settings = chosen(f"{name}/{model}")
    assert (settings.preset, settings.model) == (SHIPPED[name], model)


@given(prefix=st.text().filter(lambda text: "/" not in text and text not in SHIPPED), model=st.text())
def test_a_preset_that_is_none_is_named_and_no_key_goes_to_another(prefix, model):
    with pytest.raises(UnknownName) as caught:
        chosen(f"{prefix}/{model}")
    assert "Known: anthropic, gemini, llamacpp, lmstudio, ollama, openai, openrouter, vllm." in str(caught.value)


def test_a_mistyped_preset_is_one_line():
    with pytest.raises(UnknownName) as caught:
        chosen("ollma/qwen3")
    assert str(caught.value) == (
        "unknown preset 'ollma'; did you mean 'ollama' or 'vllm' or 'llamacpp'? Known: anthropic, gemini, llamacpp, "
        "lmstudio, ollama, openai, openrouter, vllm. LLM3_BASE_URL names a server of your own."
    )


@given(model=st.text(min_size=1).filter(str.strip).filter(lambda text: "/" not in text))
def test_any_other_name_is_one_of_openais_models(model):
    settings = chosen(model)
    assert (settings.preset, settings.model) == (SHIPPED["openai"], model)


@pytest.mark.parametrize(
    ("model", "address", "preset", "sent"),
    [
        ("meta-llama/Llama-3", LOCAL, Preset(LOCAL), "meta-llama/Llama-3"),
        ("openai/gpt-oss-20b", LOCAL, Preset(LOCAL), "openai/gpt-oss-20b"),
        ("anthropic/claude", LOCAL, Preset(LOCAL), "anthropic/claude"),
        ("qwen3", LOCAL, Preset(LOCAL), "qwen3"),
        ("ollama/qwen3", LOCAL, dataclasses.replace(SHIPPED["ollama"], base_url=LOCAL), "qwen3"),
        ("lmstudio/a/b", LOCAL, dataclasses.replace(SHIPPED["lmstudio"], base_url=LOCAL), "a/b"),
        # a known address is known by whatever name
        ("gpt", OPENAI, SHIPPED["openai"], "gpt"),
        ("openai/gpt", OPENAI, SHIPPED["openai"], "gpt"),
        ("openai/gpt", "https://openrouter.ai/api/v1/", SHIPPED["openrouter"], "openai/gpt"),
        ("qwen3", "http://127.0.0.1:11434/v1", SHIPPED["ollama"], "qwen3"),
    ],
)
def test_an_address_of_ones_own_takes_the_name_as_it_is_unless_it_names_a_local_server(model, address, preset, sent):
    settings = chosen(model, LLM3_BASE_URL=address)
    assert (settings.preset, settings.model) == (preset, sent)


KEYS = {variable: f"sk-{variable}" for preset in SHIPPED.values() for variable in preset.key_variables}
ADDRESSES = st.just("") | st.sampled_from([preset.base_url for preset in SHIPPED.values()]) | st.text()
MODELS = st.sampled_from([f"{name}/m" for name in SHIPPED]) | st.text(min_size=1)


@given(MODELS, ADDRESSES)
def test_a_presets_own_key_goes_to_its_own_address_and_nowhere_else(model, address):
    try:
        settings = chosen(model, LLM3_BASE_URL=address, **KEYS)
    except UsageError:
        return
    owner = [p for p in SHIPPED.values() if same_address(p.base_url, settings.base_url)]
    assert settings.key.reveal() in {"", *(KEYS[variable] for preset in owner for variable in preset.key_variables)}
    assert bool(settings.key) or not settings.preset.needs_key


def test_a_local_servers_own_key_stays_at_its_own_address(own):
    file = own({"mine": {"base_url": "http://127.0.0.1:8081/v1", "key_variables": ["MINE_KEY"]}})
    known = {"LLM3_PRESETS": file, "MINE_KEY": "sk-mine"}
    assert chosen("mine/m", **known).key.reveal() == "sk-mine"
    assert chosen("mine/m", LLM3_BASE_URL=LOCAL, **known).key.reveal() == ""
    assert chosen("mine/m", LLM3_BASE_URL=LOCAL, LLM3_API_KEY="sk-own", **known).key.reveal() == "sk-own"


@pytest.mark.parametrize("name", SHIPPED)
def test_the_users_one_key_comes_before_a_presets_own(name):
    assert chosen(f"{name}/m", LLM3_API_KEY="sk-own", **KEYS).key.reveal() == "sk-own"


def test_a_preset_without_a_model_is_no_model():
    with pytest.raises(UsageError) as caught:
        chosen("ollama/")
    assert str(caught.value) == "the backend 'http' needs the name of a model: give --model NAME"


def test_a_users_presets_add_to_the_shipped_ones_or_replace_them(own):
    file = own({"mine": {"base_url": LOCAL}, "ollama": {"base_url": "http://box:1/v1"}})
    known = known_presets({"LLM3_PRESETS": f" {file} "})
    assert known == {**SHIPPED, "mine": Preset(LOCAL), "ollama": Preset("http://box:1/v1")}
    assert chosen("mine/m", LLM3_PRESETS=file).preset == Preset(LOCAL)


def test_the_limit_of_a_reply_is_the_users_or_else_the_servers(own):
    file = own({"a": {"base_url": LOCAL, "max_reply_tokens": 7}, "b": {"base_url": LOCAL}})
    for asked, a, b in ((None, 7, None), (5, 5, 5)):
        limits = [
            settings_from(
                BackendSettings(model=f"{name}/m", max_reply_tokens=asked), {"LLM3_PRESETS": file}
            ).reply_limit
            for name in "ab"
        ]
        assert limits == [a, b]


@pytest.mark.parametrize(
    ("presets", "wrong"),
    [
        ("{", "Input data was truncated"),
        ([], "Expected `object`, got `array`"),
        ({"a": {}}, "Object missing required field `base_url` - at `$[...]`"),
        ({"a": {"base_url": LOCAL, "url": ""}}, "unknown field `url`"),
        ({"a": {"base_url": LOCAL, "dialect": "smtp"}}, "Invalid enum value 'smtp' - at `$[...].dialect`"),
        ({"a": {"base_url": LOCAL, "reply_formats": ["xml"]}}, "Invalid enum value 'xml'"),
        ({"a": {"base_url": "box:1"}}, "base_url is 'box:1', but must be an http:// or https:// address"),
        (
            {"a": {"base_url": "http://me:canary@box/v1"}},
            "base_url is 'http://***@box/v1', but must hold no user name and no password: give the key in LLM3_API_KEY",
        ),
        (
            {"a": {"base_url": LOCAL, "key_variables": ["sk-123"]}},
            "key_variables must be names of environment variables, of capital letters, digits and underscores, such as "
            "LAB_API_KEY; one of them is none",
        ),
        (
            {"a": {"base_url": LOCAL, "key_variables": ["LAB_API_KEY", "sk_123"]}},
            "key_variables must be names of environment variables, of capital letters, digits and underscores, such as "
            "LAB_API_KEY; one of them is none",
        ),
        ({"a": {"base_url": LOCAL, "reply_formats": []}}, "reply_formats must name different formats, not []"),
        (
            {"a": {"base_url": LOCAL, "reply_formats": ["text", "text"]}},
            "reply_formats must name different formats, not ['text', 'text']",
        ),
        ({"a": {"base_url": LOCAL, "max_reply_tokens": 0}}, "max_reply_tokens must be at least 1, not 0"),
        (
            {"a": {"base_url": LOCAL, "dialect": "messages", "reply_formats": ["text"]}},
            "the dialect messages requires max_reply_tokens, such as 8192",
        ),
        (
            {"a": {"base_url": LOCAL, "dialect": "messages", "max_reply_tokens": 1}},
            "the dialect messages has no json_object: its reply_formats are json_schema and text",
        ),
        ({"a/b": {"base_url": LOCAL}}, "a preset's name is made of letters, digits, '.', '_' and '-', not 'a/b'"),
    ],
)
def test_presets_that_cannot_be_are_refused_with_the_file_and_the_field(own, presets, wrong):
    file = own(presets)
    with pytest.raises(InputError) as caught:
        known_presets({"LLM3_PRESETS": file})
    assert str(caught.value).startswith(f"{file}: {wrong}")


def test_a_file_of_presets_that_is_not_there_is_named(tmp_path):
    file = tmp_path / "none.json"
    with pytest.raises(InputError) as caught:
        chosen("gpt", LLM3_PRESETS=str(file))
    assert str(caught.value) == f"{file}: No such file or directory"


def test_the_tokens_of_a_reply_are_at_least_one():
    with pytest.raises(UsageError) as caught:
        HttpSettings("m", Preset(LOCAL), max_reply_tokens=0)
    assert str(caught.value) == "--max-reply-tokens must be at least 1, not 0"
