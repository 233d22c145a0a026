"""`llm3 check`: what it prints, and how it ends."""

from __future__ import annotations

import json
import re

import pytest

FAULTY = """
from llm3 import FeedbackSynthesizer, LLMBackend, hookimpl
from llm3.types import Completion, Feedback

class Curt(FeedbackSynthesizer):
    def synthesize(self, attempt):
        return Feedback(attempt.number, summary=attempt.proposal and "No.  Try again.")

class Silent(LLMBackend):
    is_language_model = False
    def complete(self, request):
        return Completion("{}")

@hookimpl
def llm3_feedback():
    return {"NAME": Curt}

@hookimpl
def llm3_backends():
    return {"NAME": lambda settings: Silent()}
"""


def test_what_is_clean_is_told_in_a_line(command):
    ended = command("check corridor")
    assert (ended.code, ended.err) == (0, "")
    remark, line = ended.out.splitlines()
    assert remark == "remark: A motion problem has no explain, so a planner cannot tell a model what is in the way."
    assert line.startswith("domain 'corridor': no fault (")
    assert "rules, 2 worlds, " in line
    assert line.endswith(" were carried out).")
    assert command("check corridor").out == ended.out


def test_a_problem_of_a_file_is_looked_at(command, tmp_path):
    assert command(f"instance --domain corridor --seed 3 --out {tmp_path}/mine.json").code == 0
    ended = command(f"check corridor --instance {tmp_path}/mine.json")
    assert (ended.code, ended.err) == (0, "")
    assert "rules, 1 worlds, " in ended.out.splitlines()[-1]


def test_a_file_that_holds_no_problem_is_named(command, tmp_path):
    (tmp_path / "mine.json").write_text('{"gap": "wide"}', encoding="utf-8")
    ended = command(f"check corridor --instance {tmp_path}/mine.json")
    assert (ended.code, ended.out) == (3, "")
    (error,) = ended.err.splitlines()
    assert error.startswith("llm3: error: ")
    assert "mine.json" in error


def test_each_complaint_is_a_line_and_so_is_the_json(command, install):
    install("llm3_curt", FAULTY.replace("NAME", "curt"))
    ended = command("check curt --kind backend")
    assert (ended.code, ended.err) == (1, "")
    assert ended.out.splitlines() == [
        "the backend is no language model, and its notice does not say so. Users and records must see what wrote the "
        "replies: fill `notice`.",
        "backend 'curt': 1 fault (8 rules).",
    ]
    told = command("check curt --kind backend --json")
    assert told.code == 1
    (line,) = told.out.splitlines()
    found = json.loads(line)
    assert set(found) == {"kind", "name", "complaints", "remarks", "rules", "worlds", "actions", "applied"}
    assert [set(complaint) for complaint in found["complaints"]] == [{"rule", "text", "cause"}]


def test_a_plugin_that_raises_is_a_complaint_with_its_place(command, install):
    install(
        "llm3_rude", FAULTY.replace("NAME", "rude").replace("return Completion", "1 / 0\n        return Completion")
    )
    ended = command("check rude --kind backend")
    assert ended.code == 1
    assert ended.out.splitlines()[1].startswith(
        "Silent.complete raised ZeroDivisionError: division by zero (llm3_rude.py:"
    )


UNHEARD = """
from llm3 import LLMBackend, hookimpl
from llm3.errors import BackendError
from llm3.types import Completion

class Program(LLMBackend):
    def __init__(self, name):
        self.name, self.asked = name, 0
    def complete(self, request):
        self.asked += 1
        if self.name == "nosuchprog" or self.asked > 1:
            raise BackendError(f"the program {self.name!r} does not answer.")
        return Completion("{}")

@hookimpl
def llm3_backends():
    return {"program": lambda settings: Program(settings.argument)}
"""


def test_a_backend_that_never_answers_is_told_with_the_reason(command, install):
    install("llm3_unheard", UNHEARD)
    ended = command("check program:nosuchprog")
    assert (ended.code, ended.err) == (1, "")
    assert ended.out.splitlines() == [
        "none of 2 requests was answered: the program 'nosuchprog' does not answer. The error says why; what does not "
        "answer cannot be looked at.",
        "backend 'program:nosuchprog': 1 fault (8 rules).",
    ]


def test_a_backend_that_answers_once_is_told_of_the_other_time_in_a_remark(command, install):
    install("llm3_heard_once", UNHEARD)
    ended = command("check program:tired")
    assert (ended.code, ended.err) == (0, "")
    assert ended.out.splitlines() == [
        "remark: It gave no answer, so that could not be looked at: the program 'tired' does not answer.",
        "backend 'program:tired': no fault (8 rules).",
    ]


@pytest.mark.parametrize(
    ("line", "said"),
    [
        ("check twice", "'twice' is the name of a feedback and of a backend: give --kind feedback or --kind backend."),
        ("check birrt --setting easy", "--setting is for a domain, and 'birrt' is a planner."),
        ("check birrt --instance mine.json", "--instance is for a domain, and 'birrt' is a planner."),
        (
            "check corridor --setting default --instance mine.json",
            "--setting and --instance both choose a problem: give one of them.",
        ),
        ("check corridor --model gpt", "--model is for a backend, and 'corridor' is a domain."),
        ("check corridor --setting steep", "unknown setting 'steep' of domain 'corridor'. Known: default."),
        ("check http", "the backend 'http' needs the name of a model: give --model NAME"),
        ("check birrt --kind domain", "unknown domain 'birrt'"),
        ("check birt", "unknown plugin 'birt'; did you mean 'birrt'"),
        ("check", "the following arguments are required: NAME. See 'llm3 check --help'."),
    ],
)
def test_what_cannot_be_checked_is_said_in_a_line(command, install, line, said):
    install(re.sub(r"\W+", "_", f"llm3 {line}"), FAULTY.replace("NAME", "twice"))
    ended = command(line)
    assert (ended.code, ended.out) == (2, "")
    (error,) = ended.err.splitlines()
    assert error.startswith(f"llm3: error: {said}")
