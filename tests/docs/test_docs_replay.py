"""The page on replaying: its commands and its code run, in order, and end as it says."""

from __future__ import annotations

import dataclasses
import json
import re
import shlex
from pathlib import Path

import pytest
from docs_pages import blocks, page, table

from llm3.cli.main import main
from llm3.records import Exchange, RecordedReply, RecordedRequest, Usage, read_cassette
from llm3.testing import LLMServer

PAGE = page("replay")
INTO_THE_WALL = json.dumps({"Full Plan": ["go([], {'x': 1.0, 'y': 0.95})"]})
TO_THE_END = json.dumps({"Full Plan": ["go([], {'x': 0.5, 'y': 0.5})", "go([], {'x': 1.9, 'y': 0.5})"]})
ENDINGS = {"runs/another": 3}
"""What does not end with a solution."""


def shell(line: str) -> None:
    """The few commands on the page that are none of llm3."""
    name, *words = line.split()
    if name == "cmp":
        one, other = map(Path, words)
        assert one.read_bytes() == other.read_bytes()
    else:
        assert name == "cat"
        *parts, into, out = words
        assert into == ">"
        Path(out).write_bytes(b"".join(Path(part).read_bytes() for part in parts))


def test_the_commands_and_the_code_on_the_page_run(corridor, capsys, monkeypatch):
    monkeypatch.setenv("NO_PROXY", "127.0.0.1")
    with LLMServer([INTO_THE_WALL, TO_THE_END] * 2) as server:
        monkeypatch.setenv("LLM3_BASE_URL", server.url)
        monkeypatch.setenv("LLM3_API_KEY", "a-key-for-the-test")
        for transcript in blocks(PAGE, "console"):
            for command, expected in re.findall(r"^\$ (.*)\n((?:[^$].*\n)*)", transcript.text, re.MULTILINE):
                if not command.startswith("llm3 "):
                    shell(command)
                    continue
                line = command.removeprefix("llm3 ").replace("boxpack", "corridor")  # which is quick
                code = next((code for folder, code in ENDINGS.items() if folder in line.split()), 0)
                assert main(shlex.split(line)) == code, line
                assert capsys.readouterr().err.endswith(expected)
        assert len(server.requests) == 4  # two runs asked a model, and the others did not
    (code,) = blocks(PAGE, "python")
    exec(compile(code.text, "docs/replay.md", "exec"), {})
    printed = capsys.readouterr().out
    for promised in re.findall(r"print\(.*\)  # (.*)$", code.text, re.MULTILINE):
        assert promised + "\n" in printed
    assert len(list(read_cassette(corridor / "paper.jsonl"))) == 4


@pytest.mark.parametrize(
    ("heading", "structure"),
    {
        "What is in a cassette": Exchange,
        "request": RecordedRequest,
        "reply": RecordedReply,
        "usage": Usage,
    }.items(),
)
def test_every_field_of_a_cassette_is_documented_in_order(heading, structure):
    assert table(PAGE, heading).names == tuple(field.name for field in dataclasses.fields(structure))
