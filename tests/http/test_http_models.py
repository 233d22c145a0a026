"""`llm3 models`, and the manual's walk through a preset of one's own."""

from __future__ import annotations

import json
import os
import re
import shlex
from pathlib import Path

import pytest
from model_server import ModelServer, answer, completion

from llm3.cli.main import main
from llm3_http.presets import known_presets

PAGE = (Path(__file__).parents[2] / "docs" / "models.md").read_text(encoding="utf-8")
CANARY = "sk-c4n4ry-4711"


@pytest.fixture(autouse=True)
def surroundings(monkeypatch: pytest.MonkeyPatch) -> pytest.MonkeyPatch:
    for name in list(os.environ):
        if name.startswith("LLM3_") or name.endswith("_API_KEY"):
            monkeypatch.delenv(name)
    return monkeypatch


def table(capsys: pytest.CaptureFixture[str]) -> dict[str, str]:
    assert main(["models"]) == 0
    return {line.split()[0]: " ".join(line.split()[1:]) for line in capsys.readouterr().out.splitlines()}


def test_each_preset_is_a_line_with_its_address_and_its_key(capsys):
    shown = table(capsys)
    assert list(shown) == sorted(known_presets({}))
    assert shown["openai"] == "https://api.openai.com/v1 key not set: LLM3_API_KEY or OPENAI_API_KEY"
    assert shown["ollama"] == "http://127.0.0.1:11434/v1 key not needed"


def test_a_key_is_named_and_never_shown(capsys, surroundings):
    surroundings.setenv("OPENAI_API_KEY", CANARY)
    assert table(capsys)["openai"] == "https://api.openai.com/v1 key set: OPENAI_API_KEY"
    surroundings.setenv("LLM3_API_KEY", CANARY)
    shown = table(capsys)
    assert all(line.endswith("key set: LLM3_API_KEY") for line in shown.values())
    main(["models", "--json"])
    assert CANARY not in capsys.readouterr().out + str(shown)


def test_as_json_it_is_a_list(capsys):
    assert main(["models", "--json"]) == 0
    told = json.loads(capsys.readouterr().out)
    assert {
        "name": "gemini",
        "address": "https://generativelanguage.googleapis.com/v1beta/openai",
        "key": "not set",
        "key_variables": ["LLM3_API_KEY", "GEMINI_API_KEY"],
    } in told
    assert [source["name"] for source in told] == sorted(known_presets({}))


def test_a_file_of_presets_that_is_wrong_is_an_error_of_one_line(capsys, surroundings, tmp_path):
    (tmp_path / "presets.json").write_text('{"mine": {}}')
    surroundings.setenv("LLM3_PRESETS", str(tmp_path / "presets.json"))
    assert main(["models"]) == 3
    printed = capsys.readouterr()
    assert printed.out == ""
    assert printed.err == (
        f"llm3: error: {tmp_path / 'presets.json'}: Object missing required field `base_url` - at `$[...]`\n"
    )


def test_the_walk_through_of_the_manual_adds_a_server_by_writing_data_only(
    capsys, server: ModelServer, surroundings, tmp_path
):
    section = PAGE.partition("## A server of your own")[2].partition("\n## ")[0]
    (data,) = re.findall(r"```json\n(.*?)```", section, re.DOTALL)
    (transcript,) = re.findall(r"```console\n(.*?)```", section, re.DOTALL)
    written = json.loads(data)["lab"]["base_url"]
    surroundings.chdir(tmp_path)
    Path("presets.json").write_text(data.replace(written, server.url), encoding="utf-8")
    reply = completion('{"Reasoning": "", "Full Plan": []}', usage={"prompt_tokens": 31, "completion_tokens": 12})
    server.script = (answer(reply | {"model": "small"}),)

    printed = ""
    for command in re.findall(r"^\$ (.*)$", transcript, re.MULTILINE):
        words = shlex.split(command)
        if words[0] == "export":
            surroundings.setenv(*words[1].split("=", 1))
        else:
            assert words[0] == "llm3"
            assert main(words[1:]) == 0
            lines = capsys.readouterr().out.splitlines()
            printed += "".join(f"{line}\n" for line in lines if "doctor" in words or line.startswith("lab "))
    shown = [line for line in transcript.splitlines() if not line.startswith("$") and line != "..."]
    squeezed = [" ".join(line.split()) for line in printed.replace(server.url, written).splitlines()]
    assert squeezed == [" ".join(line.split()) for line in shown]
    assert server.received[0].payload["response_format"]["type"] == "json_object"
    assert server.received[0].headers["authorization"] == "Bearer sk-lab"
