"""`llm3 instance`, `--instance FILE` and `llm3 prompt`."""

from __future__ import annotations

import json
import os

import pytest

BAD_FILES = {
    "wrong type": ('{"gap": "wide"}', 'Expected `float`, got `str` "wide" - at `$.gap`'),
    "missing field": ("{}", "Object missing required field `gap`"),
    "unknown field": ('{"gap": 0.5, "gaps": 2}', "unknown field `gaps`, expected gap - at `$`"),
    "no object": ("[]", "Expected `object`, got `array`"),
    "cut off": ('{"gap"', "Input data was truncated"),
    "empty": ("", "empty"),
    "blank": (" \n", "empty"),
}


def test_instance_prints_the_problem(command):
    assert command("instance --domain corridor --seed 3").out == '{\n  "gap": 0.25\n}\n'


def test_the_same_problem_from_a_file_is_the_same_run(command, corridor, cwd):
    command("instance --domain corridor --seed 3 --out problem.json")
    corridor("--seed 3 --out by-seed --quiet")
    corridor("--seed 3 --instance problem.json --out by-file --quiet")
    assert (cwd / "by-seed/plan.json").read_bytes() == (cwd / "by-file/plan.json").read_bytes()
    assert json.loads((cwd / "by-file/run.json").read_text(encoding="utf-8"))["config"]["setting"] is None


def test_instance_overwrites_only_by_force(command, cwd):
    (cwd / "problem.json").write_text("mine")
    ended = command("instance --domain corridor --out problem.json")
    assert (ended.code, ended.out) == (2, "")
    assert ended.err == "llm3: error: 'problem.json' exists: choose another file, or give --force.\n"
    assert (cwd / "problem.json").read_text() == "mine"
    assert command("instance --domain corridor --out problem.json --force").code == 0
    assert (cwd / "problem.json").read_text() == command("instance --domain corridor").out


def test_force_follows_a_link_and_writes_into_a_pipe(command, cwd):
    (cwd / "there.json").touch()
    (cwd / "link.json").symlink_to("there.json")
    assert command("instance --domain corridor --out link.json --force").code == 0
    assert (cwd / "link.json").is_symlink()
    assert (cwd / "there.json").read_text() == command("instance --domain corridor").out
    os.mkfifo(cwd / "pipe")
    reader = os.open(cwd / "pipe", os.O_RDONLY | os.O_NONBLOCK)
    try:
        assert command("instance --domain corridor --out pipe --force").code == 0
        assert os.read(reader, 10_000) == (cwd / "there.json").read_bytes()
    finally:
        os.close(reader)
    assert (cwd / "pipe").is_fifo()


def test_instance_says_why_a_file_cannot_be_written(command):
    ended = command("instance --domain corridor --out nowhere/problem.json")
    assert ended.code == 3
    assert ended.err == "llm3: error: 'nowhere/problem.json' cannot be written: No such file or directory.\n"


@pytest.mark.parametrize("kind", BAD_FILES)
@pytest.mark.parametrize("line", ["--domain corridor", "prompt --domain corridor"])
def test_a_wrong_file_gets_one_line_that_names_the_field(command, cwd, line, kind):
    text, sentence = BAD_FILES[kind]
    (cwd / "problem.json").write_text(text)
    ended = command(f"{line} --instance problem.json")
    assert (ended.code, ended.out, ended.err) == (3, "", f"llm3: error: problem.json: {sentence}\n")


def test_a_missing_file_is_named(corridor):
    assert corridor("--instance gone.json").err == "llm3: error: gone.json: No such file or directory\n"


def test_prompt_prints_what_would_be_sent_and_sends_nothing(command, corridor, script, cwd):
    shown = command("prompt --domain corridor --strategy scratch --seed 3")
    assert (shown.code, shown.err) == (0, "")
    assert not list(cwd.iterdir())
    messages = json.loads(command("prompt --domain corridor --strategy scratch --seed 3 --json").out)
    assert shown.out == "\n\n".join(f"--- {m['role']} ---\n\n{m['content']}" for m in messages) + "\n"
    corridor(f"{script('')} --strategy scratch --seed 3 --max-llm-calls 1 --out here --quiet")
    events = map(json.loads, (cwd / "here/events.jsonl").read_text(encoding="utf-8").splitlines())
    (sent,) = [e["messages"] for e in events if e.get("event") == "PromptSent"]
    assert messages == sent


def test_prompt_takes_the_problem_from_a_file(command, cwd):
    (cwd / "problem.json").write_text('{"gap": 0.456}')
    assert "gap (0.356, 0.556)" in command("prompt --domain corridor --instance problem.json").out


def test_prompt_shows_the_given_sequence(command):
    shown = command("prompt --domain corridor --strategy sample-params").out
    assert "1. go([], ...)\n2. go([], ...)\n" in shown


def test_a_strategy_that_needs_a_sequence_says_so(command, install):
    install(
        "llm3_wordless",
        """
from llm3 import hookimpl
from llm3_corridor import Corridor

class Wordless(Corridor):
    name = "wordless"
    def skeleton(self, instance):
        return None

@hookimpl
def llm3_domains():
    return {"wordless": Wordless}
""",
    )
    sentence = "llm3: error: domain 'wordless' has no skeleton, which {} needs.\n"
    for line in ("--domain wordless --strategy sample-params", "prompt --domain wordless --strategy sample-params"):
        ended = command(line)
        assert (ended.code, ended.out, ended.err) == (2, "", sentence.format("strategy 'sample-params'"))
    ended = command("--domain wordless --llm random")
    assert (ended.code, ended.out, ended.err) == (2, "", sentence.format("the backend 'random'"))
    ended = command("--domain wordless")
    assert (ended.code, ended.out) == (2, "")
    assert ended.err == (
        "llm3: error: domain 'wordless' has no rule-based stand-in and no skeleton to draw parameters for: "
        "give --model NAME or --llm scripted:FILE.\n"
    )


def test_a_file_of_which_no_world_can_be_made_is_named(command, install, cwd):
    install(
        "llm3_cramped",
        """
from llm3 import hookimpl
from llm3.errors import InstanceError
from llm3_corridor import Corridor

class Cramped(Corridor):
    name = "cramped"
    def make(self, instance, options):
        if instance.gap < 0.1:
            raise InstanceError("the robot and the wall start in one another")
        return super().make(instance, options)

@hookimpl
def llm3_domains():
    return {"cramped": Cramped}
""",
    )
    (cwd / "problem.json").write_text('{"gap": 0.05}')
    sentence = "the robot and the wall start in one another"
    for line in ("--domain cramped", "prompt --domain cramped"):
        ended = command(f"{line} --instance problem.json")
        assert (ended.code, ended.out, ended.err) == (3, "", f"llm3: error: problem.json: {sentence}\n")
    (cwd / "problem.json").write_text('{"gap": 0.25}')
    assert command("--domain cramped --instance problem.json --out run --quiet").code == 0
    for name, where in (("plan.json", "the plan's instance"), ("run.json", "run/run.json, instance")):
        text = (cwd / "run" / name).read_text(encoding="utf-8")
        assert '"gap":0.25' in text.replace(" ", "")
        (cwd / "run" / name).write_text(text.replace("0.25", "0.05"), encoding="utf-8")
        ended = command("verify run" if name == "plan.json" else "--llm replay:run --quiet --out again")
        assert (ended.code, ended.out, ended.err) == (3, "", f"llm3: error: {where}: {sentence}\n")
