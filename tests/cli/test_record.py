"""Where the record of a run goes, and that nothing is lost there."""

from __future__ import annotations

import json
import re

import pytest

RECORD = {"run.json", "events.jsonl", "plan.json"}
CRASHING = """
from llm3 import LLMBackend, hookimpl
from llm3.types import Completion

class Crashing(LLMBackend):
    calls = 0
    def __init__(self, error):
        self.error = error
    def complete(self, request):
        self.calls += 1
        if self.calls > 1:
            raise self.error
        return Completion("not yet")

@hookimpl
def llm3_backends():
    return {
        "buggy": lambda settings: Crashing(ZeroDivisionError("once\\nmore")),
        "piping": lambda settings: Crashing(BrokenPipeError("a pipe of the backend's own")),
        "stopped": lambda settings: Crashing(KeyboardInterrupt()),
    }
"""


def names(folder):
    return {path.name for path in folder.iterdir()}


def read(folder):
    """run.json and the events; every line must be whole."""
    events = (folder / "events.jsonl").read_text(encoding="utf-8").splitlines()
    return json.loads((folder / "run.json").read_text(encoding="utf-8")), [json.loads(line) for line in events]


def test_by_default_each_run_gets_a_new_folder(corridor, cwd):
    folders = {corridor("--quiet --json").out for _ in range(2)}
    places = {json.loads(line)["out"] for line in folders}
    assert len(places) == 2
    for place in places:
        assert re.fullmatch(r"runs/\d{8}-\d{6}-corridor-default-0(-\d+)?", place)
        assert names(cwd / place) == RECORD


def test_a_folder_with_something_in_it_is_refused_and_left_alone(corridor, cwd):
    (cwd / "here").mkdir()
    (cwd / "here/run.json").write_text("mine")
    ended = corridor("--out here")
    assert (ended.code, ended.out) == (2, "")
    assert ended.err == "llm3: error: the output folder 'here' is not empty: choose another, or give --force.\n"
    assert (cwd / "here/run.json").read_text() == "mine"
    assert names(cwd / "here") == {"run.json"}


def test_force_overwrites_the_record_and_nothing_else(corridor, cwd):
    assert corridor("--out here --quiet").code == 0
    (cwd / "here/notes.txt").write_text("mine")
    assert corridor("--out here --force --quiet --max-llm-calls 1").code == 1
    assert names(cwd / "here") == {"run.json", "events.jsonl", "notes.txt"}
    assert read(cwd / "here")[0]["status"] == "not solved"


def test_an_empty_folder_needs_no_force(corridor, cwd):
    (cwd / "here").mkdir()
    assert corridor("--out here --quiet").code == 0
    assert names(cwd / "here") == RECORD


def test_a_file_in_the_way_is_named(corridor, cwd):
    (cwd / "here").write_text("mine")
    ended = corridor("--out here")
    assert (ended.code, ended.out) == (2, "")
    assert ended.err == "llm3: error: 'here' is a file, not a folder: choose another.\n"
    assert (cwd / "here").read_text() == "mine"


@pytest.mark.parametrize(
    ("llm", "code", "last", "status", "error"),
    [
        (
            "buggy", 3, "llm3: error: Crashing.complete raised ZeroDivisionError: once more (llm3_crashing.py:12).",
            "error", "Crashing.complete raised ZeroDivisionError: once more (llm3_crashing.py:12).",
        ),
        (
            "piping", 3,
            "llm3: error: Crashing.complete raised BrokenPipeError: a pipe of the backend's own (llm3_crashing.py:12).",
            "error", "Crashing.complete raised BrokenPipeError: a pipe of the backend's own (llm3_crashing.py:12).",
        ),
        ("stopped", 130, "llm3: interrupted.", "interrupted", ""),
        ("scripted:replies.json", 3, "llm3: error: the script has run out after 1 reply.", "error",
         "the script has run out after 1 reply."),
    ],
)  # fmt: skip
def test_a_run_that_breaks_off_leaves_what_was_done(corridor, install, script, cwd, llm, code, last, status, error):
    install("llm3_crashing", CRASHING)
    script("not yet")
    ended = corridor(f"--llm {llm} --out here --json")
    assert (ended.code, ended.out) == (code, "")
    assert ended.err.splitlines()[-1] == last
    assert "Traceback" not in ended.err
    told, events = read(cwd / "here")
    assert (told["status"], told["error"], told["stats"]["llm_calls"]) == (status, error, 1)
    assert [e.get("event") for e in events] == [
        None, "RunStarted", "PromptSent", "ReplyReceived", "ReplyRead", "AttemptEnded", "PromptSent",
        *(["CallFailed"] if llm.startswith("scripted") else []),
    ]  # fmt: skip
    assert names(cwd / "here") == {"run.json", "events.jsonl"}
