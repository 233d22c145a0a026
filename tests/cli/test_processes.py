"""What only a real process shows: signals, closed pipes, warnings at start-up, a server that is not there."""

from __future__ import annotations

import json
import os
import signal
import subprocess
import sys
import time
from pathlib import Path

import pytest
from command_line import environment, llm3, run

HANGING = """
import time
from llm3 import LLMBackend, hookimpl

class Hanging(LLMBackend):
    def complete(self, request):
        time.sleep(600)

@hookimpl
def llm3_backends():
    return {"hanging": lambda settings: Hanging()}
"""


@pytest.mark.parametrize(
    ("sent", "code", "said"),
    [(signal.SIGINT, 130, "llm3: interrupted.\n"), (signal.SIGTERM, 143, "llm3: terminated.\n")],
)
def test_ctrl_c_and_sigterm_end_a_run_cleanly(cwd, install, surroundings, sent, code, said):
    install("llm3_hanging", HANGING)
    ignored = signal.signal(signal.SIGINT, signal.default_int_handler)  # a child inherits what is ignored
    try:
        process = subprocess.Popen(
            llm3("--domain corridor --llm hanging --out here --json"),
            cwd=cwd, env=surroundings, stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True,
        )  # fmt: skip
    finally:
        signal.signal(signal.SIGINT, ignored)
    try:
        events = cwd / "here/events.jsonl"
        while not (events.exists() and "PromptSent" in events.read_text(encoding="utf-8")):
            assert process.poll() is None
            time.sleep(0.02)
        process.send_signal(sent)
        out, err = process.communicate(timeout=60)
    finally:
        process.kill()
    assert (process.returncode, out, err) == (code, "", said)
    told = json.loads((cwd / "here/run.json").read_text(encoding="utf-8"))
    assert (told["status"], told["error"]) == ("interrupted", "")
    for line in events.read_text(encoding="utf-8").splitlines():
        json.loads(line)
    assert {path.name for path in (cwd / "here").iterdir()} == {"run.json", "events.jsonl"}


def closed_pipe() -> int:
    """The writing end of a pipe that nobody reads."""
    reading, writing = os.pipe()
    os.close(reading)
    return writing


@pytest.mark.parametrize("line", ["list", "list --json", "--help", "prompt --domain corridor"])
def test_a_reader_that_leaves_is_no_error(cwd, surroundings, line):
    writing = closed_pipe()
    done = subprocess.run(llm3(line), cwd=cwd, env=surroundings, stdout=writing, stderr=subprocess.PIPE, text=True)
    os.close(writing)
    assert (done.returncode, done.stderr) == (0, "")


def test_a_reader_that_leaves_does_not_make_a_run_solved(cwd, surroundings):
    writing = closed_pipe()
    command = llm3("--domain corridor --max-llm-calls 1 --json --quiet")
    done = subprocess.run(command, cwd=cwd, env=surroundings, stdout=writing, stderr=subprocess.PIPE, text=True)
    os.close(writing)
    assert (done.returncode, done.stderr) == (1, "")


def test_a_watcher_that_leaves_does_not_end_the_run(cwd, surroundings):
    writing = closed_pipe()
    done = subprocess.run(
        llm3("--domain corridor --out here"),
        cwd=cwd, env=surroundings, stdout=subprocess.PIPE, stderr=writing, text=True,
    )  # fmt: skip
    os.close(writing)
    assert done.returncode == 0
    assert done.stdout.startswith("go([], {'x': ")
    assert json.loads((cwd / "here/run.json").read_text(encoding="utf-8"))["status"] == "solved"


def test_the_console_script_is_the_same_program(cwd, surroundings):
    script = Path(sys.executable).with_name("llm3")
    done = run([str(script), "list"], cwd, surroundings)
    assert done == run(llm3("list"), cwd, surroundings)
    assert done.code == 0


@pytest.mark.slow
def test_no_server_is_one_line_and_the_record_is_intact(cwd, plugins):
    env = environment(plugins, LLM3_BASE_URL="http://127.0.0.1:9")
    done = run(llm3("--domain corridor --model some-model --out here"), cwd, env)
    sentence = "no server answers at http://127.0.0.1:9: start it, or set LLM3_BASE_URL"
    assert (done.code, done.out, done.err) == (3, "", f"llm3: error: {sentence}\n")
    told = json.loads((cwd / "here/run.json").read_text(encoding="utf-8"))
    assert (told["status"], told["error"]) == ("error", sentence)
    events = (cwd / "here/events.jsonl").read_text(encoding="utf-8").splitlines()
    assert [json.loads(line).get("event") for line in events] == [None, "RunStarted", "PromptSent", "CallFailed"]
