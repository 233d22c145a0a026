"""What `llm3 new` writes works as it is: it is found, checked, run, and its tests pass."""

from __future__ import annotations

import json
import sys

import pytest
from command_line import run

SEEDS = range(5)


@pytest.mark.parametrize("kind", ["domain", "planner", "feedback", "strategy", "backend"])
def test_it_is_listed_and_has_no_fault(command, new, kind):
    new(kind, f"checked-{kind}")
    (found,) = [thing for thing in json.loads(command("list --json").out)[kind] if thing["name"] == f"checked-{kind}"]
    assert found["plugin"] == f"checked-{kind} (llm3-checked-{kind} 0.1.0)"
    assert found["description"]
    ended = command(f"check checked-{kind}{':cat' if kind == 'backend' else ''}")
    assert (ended.code, ended.err) == (0, ""), ended.out
    assert "remark" not in ended.out


@pytest.mark.parametrize("flags", ["", "--llm random", "--solver search", "--strategy sample-params"])
def test_the_domain_is_solved_without_a_model(command, new, flags):
    new("domain", "solved")
    for seed in SEEDS:
        ended = command(f"--domain solved --seed {seed} --quiet {flags}")
        assert ended.code == 0, ended.err
        take, put = ended.out.splitlines()
        assert take == "take(['ball'], {})"
        assert put.startswith("put(['ball'], {'x': 1.")


@pytest.mark.pybullet
@pytest.mark.parametrize("flags", ["", "--solver search"])
def test_the_domain_with_an_arm_is_solved_without_a_model(command, new, flags):
    new("domain", "armed", "--bullet")
    ended = command(f"--domain armed --quiet {flags}")
    assert ended.code == 0, ended.err
    assert ended.out.splitlines()[-1].startswith("place(['box'], {'x': ")


def test_what_failed_in_the_domain_is_told_to_the_model(command, new, cwd):
    new("domain", "told")
    instance = json.dumps({"ball": [0.3, 0.5], "pillar": [1.5, 0.5]})
    (cwd / "pillar.json").write_text(instance, encoding="utf-8")
    plans = (["put(['ball'], {'x': 1.9, 'y': 0.5})"], ["take(['ball'], {})", "put(['ball'], {'x': 1.6, 'y': 0.5})"])
    (cwd / "replies.json").write_text(json.dumps([json.dumps({"Full Plan": plan}) for plan in plans]))
    ended = command("--domain told --instance pillar.json --llm scripted:replies.json --max-llm-calls 2 --out told-run")
    assert ended.code == 1
    assert "The robot does not hold ball: take it first." in ended.err
    assert "goal in collision (pillar)" in ended.err


@pytest.mark.parametrize(
    ("instance", "wrong"),
    [
        ({"ball": [3, 0.5], "pillar": [1.5, 0.5]}, "the ball must be in the room of 2 by 1 m, not at (3.0, 0.5)"),
        ({"ball": [1.5, 0.4], "pillar": [1.5, 0.5]}, "the ball at (1.5, 0.4) is inside of the pillar at (1.5, 0.5)"),
    ],
)
def test_a_wrong_instance_of_the_domain_is_refused(command, new, cwd, instance, wrong):
    new("domain", "refused")
    (cwd / "wrong.json").write_text(json.dumps(instance), encoding="utf-8")
    ended = command("--domain refused --instance wrong.json")
    assert ended.code == 3
    assert wrong in ended.err


def test_the_planner_and_the_feedback_solve_the_corridor(command, new):
    new("planner", "solving")
    new("feedback", "telling")
    for seed in SEEDS:
        ended = command(f"--domain corridor --planner solving --feedback telling --seed {seed}")
        assert ended.code == 0, ended.err


def test_the_strategy_asks_for_the_corridor(command, new):
    new("strategy", "asking")
    ended = command("prompt --domain corridor --strategy asking")
    assert ended.code == 0
    assert "Think in three sentences at most" in ended.out


def test_the_backend_asks_a_program(command, new, cwd):
    new("backend", "asked")
    reply = """{"Full Plan": ["go([], {'x': 0.5, 'y': 0.5})"]}"""
    program = f"import json, sys; assert json.load(sys.stdin)[0]['role'] == 'system'; print({reply!r})"
    (cwd / "program.py").write_text(program, encoding="utf-8")
    ended = command("--domain", "corridor", "--llm", f"asked:{sys.executable} program.py", "--max-llm-calls", "1")
    assert ended.code == 1, ended.err
    assert "   1. go([], {'x': 0.5, 'y': 0.5}): feasible" in ended.err
    for argument, wrong in {
        "asked": "name the program that is asked: --llm asked:PROGRAM.",
        "asked:no-such-program": "'no-such-program' cannot be asked: ",
        f"asked:{sys.executable} missing.py": f"'{sys.executable}' ended with exit code 2: ",
    }.items():
        ended = command("--domain", "corridor", "--llm", argument)
        assert wrong in ended.err


def test_their_own_tests_pass(new, surroundings, tmp_path):
    kinds = ("domain", "planner", "feedback", "strategy", "backend")
    folders = [str(new(kind, f"own-{kind}")) for kind in kinds]
    ended = run(
        [sys.executable, "-W", "error", "-m", "pytest", "-q", "-p", "no:cacheprovider", *folders],
        tmp_path,
        surroundings,
    )
    assert ended.code == 0, ended.out
    assert "13 passed" in ended.out
