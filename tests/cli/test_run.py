"""`llm3 --domain …`: what goes to stdout, what to stderr, and what each flag does."""

from __future__ import annotations

import json

import pytest
from hypothesis import HealthCheck, given, settings
from hypothesis import strategies as st

from llm3.cli.text import printable

BLOCKED = """{"Full Plan": ["go([], {'x': 0.5, 'y': 0.5})", "go([], {'x': 1.0, 'y': 0.9})"]}"""
SOLVING = """{"Full Plan": ["go([], {'x': 0.5, 'y': 0.5})", "go([], {'x': 1.9, 'y': 0.5})"]}"""
SHORT = """{"Full Plan": ["go([], {'x': 0.5, 'y': 0.5})"]}"""
KEYS = {
    "solved", "domain", "setting", "seed", "solver", "strategy", "feedback", "llm", "model", "planner", "llm_calls",
    "motion_calls", "reused_actions", "seconds", "plan", "out", "stop", "prompt_tokens", "completion_tokens", "cost",
}  # fmt: skip


def test_a_solved_run_prints_the_plan_and_tells_the_story_on_stderr(corridor, script):
    ended = corridor(f"{script(BLOCKED, SOLVING)} --out here")
    assert (ended.code, ended.out) == (0, "go([], {'x': 0.5, 'y': 0.5})\ngo([], {'x': 1.9, 'y': 0.5})\n")
    *story, summary, record = ended.err.splitlines()
    assert story == [
        "No language model is used: the replies come from a script.",
        "attempt 1 of 20: a plan of 2 actions",
        "   1. go([], {'x': 0.5, 'y': 0.5}): feasible",
        "   2. go([], {'x': 1.0, 'y': 0.9}): goal in collision (wall)",
        "attempt 2 of 20: a plan of 2 actions",
        "   1. go([], {'x': 0.5, 'y': 0.5}): feasible (known)",
        "   2. go([], {'x': 1.9, 'y': 0.5}): feasible",
    ]
    assert summary.startswith("solved in ")
    assert summary.endswith(" s: 2 model calls, 3 motion calls, 1 action reused")
    assert record == "record: here"


def test_an_unsolved_run_prints_no_plan_and_exits_1(corridor, script):
    ended = corridor(f"{script(SHORT)} --max-llm-calls 1 --out here")
    assert (ended.code, ended.out) == (1, "")
    tried, unmet, summary, why, _ = ended.err.splitlines()[-5:]
    assert why == "the budget of model calls is used up"
    assert tried == "   1. go([], {'x': 0.5, 'y': 0.5}): feasible"
    assert unmet == "    goal not reached: the robot is not at the end of the corridor"
    assert summary.startswith("not solved in ")
    assert summary.endswith(" s: 1 model call, 1 motion call, 0 actions reused")


@pytest.mark.parametrize("calls", [1, 20], ids=["not solved", "solved"])
def test_json_is_one_object_with_exactly_the_documented_keys(corridor, calls):
    ended = corridor(f"--json --out here --max-llm-calls {calls}")
    (line,) = ended.out.splitlines()
    told = json.loads(line)
    assert set(told) == KEYS
    assert ended.code == (0 if told["solved"] else 1)
    seconds, plan, llm_calls, motion_calls = (told.pop(k) for k in ("seconds", "plan", "llm_calls", "motion_calls"))
    assert seconds >= 0
    assert bool(plan) == told["solved"] == (calls == 20)
    assert 1 <= llm_calls <= calls
    assert motion_calls >= 1
    assert told == {
        "solved": calls == 20, "domain": "corridor", "setting": "default", "seed": 0,
        "solver": "loop", "strategy": "backtrack",
        "feedback": "categorized", "llm": "offline", "model": None, "planner": "birrt", "reused_actions": 0,
        "out": "here", "stop": "solved" if calls == 20 else "calls", "prompt_tokens": 0, "completion_tokens": 0,
        "cost": None,
    }  # fmt: skip


def test_a_domain_without_a_stand_in_falls_back_to_random_and_says_so(corridor, cwd):
    ended = corridor("--out here")
    notice = (
        "No language model is used: domain 'corridor' has no rule-based stand-in, "
        "so the backend 'random' draws the parameters."
    )
    assert ended.code == 0
    assert ended.err.splitlines()[0] == notice
    told = json.loads((cwd / "here/run.json").read_text(encoding="utf-8"))
    assert (told["language_model"], told["notice"]) == (False, notice)


def test_quiet_leaves_stderr_empty_and_stdout_as_it_is(corridor):
    assert corridor("--quiet").err == ""
    assert corridor("--quiet").out == corridor().out


def test_no_subcommand_means_run(command):
    assert command("run --domain corridor --quiet") == command("--domain corridor --quiet")


def test_every_choice_is_what_the_record_says_was_asked(corridor, cwd):
    corridor(
        "--setting default --seed 7 --strategy sample-params --feedback binary --llm random --planner birrt "
        "--planner-iterations 99 --planner-seconds 9 --timing none --max-llm-calls 3 --trace-size 2 "
        "--max-reply-tokens 500 --max-tokens-total 10000 --max-seconds 60 --solver loop "
        "--max-motion-calls 500 --out here --quiet"
    )
    assert json.loads((cwd / "here/run.json").read_text(encoding="utf-8"))["config"] == {
        "domain": "corridor", "setting": "default", "seed": 7, "solver": "loop",
        "strategy": "sample-params", "feedback": "binary",
        "llm": "random", "model": None, "temperature": None, "planner": "birrt", "planner_iterations": 99,
        "planner_seconds": 9.0, "timing": "none", "max_llm_calls": 3, "trace_size": 2,
        "max_reply_tokens": 500, "max_tokens_total": 10000, "max_seconds": 60.0,
        "max_motion_calls": 500, "options": {},
    }  # fmt: skip


def test_the_defaults_are_those_of_the_paper(corridor, cwd):
    corridor("--out here --quiet")
    config = json.loads((cwd / "here/run.json").read_text(encoding="utf-8"))["config"]
    assert (config["max_llm_calls"], config["trace_size"], config["feedback"]) == (20, 5, "categorized")


def test_a_model_implies_the_http_backend(corridor, cwd):
    ended = corridor("--model some-model --temperature 0.5 --out here")
    assert (ended.code, ended.out) == (3, "")
    assert ended.err == (
        "llm3: error: https://api.openai.com/v1 needs a key: "
        "set LLM3_API_KEY or OPENAI_API_KEY, or LLM3_BASE_URL for another server\n"
    )
    assert not (cwd / "here").exists()


def test_a_run_that_cannot_begin_costs_no_earlier_record(corridor, cwd):
    corridor("--llm random --out here")
    before = (cwd / "here/run.json").read_bytes()
    assert corridor("--model some-model --out here --force").code == 3
    assert (cwd / "here/run.json").read_bytes() == before
    assert (cwd / "here/plan.json").exists()


def test_the_record_names_the_model_and_its_backend(corridor, cwd, monkeypatch):
    monkeypatch.setenv("LLM3_BASE_URL", "http://127.0.0.1:9/v1")
    monkeypatch.setattr("time.sleep", lambda seconds: None)
    assert corridor("--model some-model --temperature 0.5 --out here").code == 3
    told = json.loads((cwd / "here/run.json").read_text(encoding="utf-8"))
    assert told["status"] == "error"
    assert (told["config"]["llm"], told["config"]["model"], told["config"]["temperature"]) == (
        "http",
        "some-model",
        0.5,
    )


def test_domain_options_reach_the_domain(command, install, cwd):
    install(
        "llm3_optional",
        """
from llm3 import Option, hookimpl
from llm3_corridor import Corridor

class Optional(Corridor):
    name = "optional"
    options = (Option("floor", "stone", "what it is made of", ("stone", "wood")), Option("lamps", "1", "how many"))
    def make(self, instance, options):
        print(sorted(options.items()))
        return super().make(instance, options)

@hookimpl
def llm3_domains():
    return {"optional": Optional}
""",
    )
    options = command("--domain optional -D lamps=a=b --quiet --out here")
    assert options.err.splitlines()[0] == "[('floor', 'stone'), ('lamps', 'a=b')]"  # a plugin's print is no result
    assert options.out.startswith("go(")
    assert json.loads((cwd / "here/run.json").read_text(encoding="utf-8"))["config"]["options"] == {"lamps": "a=b"}
    assert command("--domain optional -D flor=wood").err == (
        "llm3: error: unknown option 'flor' of domain 'optional'; did you mean 'floor'? Known: floor, lamps.\n"
    )
    assert command("--domain optional -D floor=wod").err == (
        "llm3: error: unknown value 'wod' of option 'floor'; did you mean 'wood'? Known: stone, wood.\n"
    )


def test_version(command):
    from importlib import metadata

    assert command("--version").out == f"llm3 {metadata.version('llm3')}\n"


@pytest.mark.parametrize("line", ["--help", "run --help", "prompt --help", "instance --help", "list -h"])
def test_help_goes_to_stdout_and_exits_0(command, line):
    ended = command(line)
    assert (ended.code, ended.err) == (0, "")
    assert ended.out.startswith("usage: llm3")


def test_the_help_reads_the_same_in_any_terminal(command, monkeypatch):
    wide = command("--help")
    monkeypatch.setenv("COLUMNS", "40")
    assert command("--help") == wide


@given(st.text())
@settings(suppress_health_check=[HealthCheck.function_scoped_fixture])
def test_no_text_moves_the_cursor(text):
    shown = printable(text)
    assert shown == "" or shown.isprintable()
    assert "\n" not in printable(text, keep_spaces=True)


SPENDING = """\
from llm3 import hookimpl
from llm3.interfaces import LLMBackend
from llm3.types import Completion, Stats

class Spending(LLMBackend):
    def complete(self, request):
        return Completion("not yet", Stats(prompt_tokens=3_000_000, completion_tokens=500_000))

@hookimpl
def llm3_backends():
    return {"spending": lambda settings: Spending()}
"""


@pytest.mark.parametrize(("model", "cost"), [("lab/small", 20.0), ("lab/other", None)])
def test_a_bill_is_told_where_the_price_is_known(corridor, install, cwd, model, cost):
    install("llm3_spending", SPENDING)
    (cwd / "prices.json").write_text('{"lab/small": {"read": 2, "written": 8}}')
    ended = corridor(f"--llm spending --model {model} --prices prices.json --max-llm-calls 2 --json")
    assert json.loads(ended.out)["cost"] == cost
    line = "6,000,000 tokens read, 1,000,000 written"
    assert (f"{line}: 20 by the price table" if cost else line) in ended.err.splitlines()


def test_a_run_that_is_ended_by_its_tokens_says_so(corridor, install):
    install("llm3_spending", SPENDING)
    ended = corridor("--llm spending --model m --max-tokens-total 4000000 --json")
    told = json.loads(ended.out)
    assert (ended.code, told["stop"], told["llm_calls"]) == (1, "tokens", 2)
    assert "the budget of tokens is used up" in ended.err.splitlines()


def test_a_price_table_that_is_none_is_refused_before_anything_is_spent(corridor, cwd):
    (cwd / "prices.json").write_text("[]")
    ended = corridor("--prices prices.json --out here")
    assert (ended.code, ended.err) == (3, "llm3: error: prices.json: Expected `object`, got `array`\n")
    assert not (cwd / "here").exists()


SILENT = """\
from llm3 import hookimpl
from llm3.errors import BackendError
from llm3.interfaces import LLMBackend

class Silent(LLMBackend):
    def complete(self, request):
        raise BackendError("no server answers.", retries=1, out_of_time=True)

@hookimpl
def llm3_backends():
    return {"silent": lambda settings: Silent()}
"""


def test_a_run_that_waits_in_vain_until_its_time_is_over_says_for_what(corridor, install):
    install("llm3_silent", SILENT)
    ended = corridor("--llm silent --max-seconds 60 --json")
    assert (ended.code, json.loads(ended.out)["stop"]) == (1, "seconds")
    assert "the last call got no answer: no server answers." in ended.err.splitlines()
    assert ended.err.count("no server answers") == 1


def test_tokens_that_nobody_counts_are_no_budget_and_that_is_said(corridor):
    ended = corridor("--max-tokens-total 10")
    line = "no tokens were counted: the model's server tells of none, so --max-tokens-total did nothing"
    assert line in ended.err.splitlines()
