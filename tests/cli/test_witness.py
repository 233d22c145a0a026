"""`llm3 instance --witness`: a plan that proves that a problem can be solved."""

from __future__ import annotations

import json

import pytest

PROVEN = """
from llm3 import hookimpl
from llm3.interfaces import PlanVerifier
from llm3.types import Action, Defect, Verification
from llm3_corridor import Corridor

class Anything(PlanVerifier):
    def verify(self, start, actions):
        return Verification(tuple(DEFECTS))

class Proven(Corridor):
    name = "NAME"
    def witness(self, setting, seed):
        gap = self.instance(setting, seed).gap
        return WITNESS
    def verifier(self, instance, options):
        return Anything()

@hookimpl
def llm3_domains():
    return {"NAME": Proven}
"""
THROUGH = 'Action("go", (), {"x": 0.8, "y": gap}), Action("go", (), {"x": 1.2, "y": gap})'
WHOLE = f'({THROUGH}, Action("go", (), {{"x": 1.9, "y": gap}}))'


@pytest.fixture
def proven(install):
    """Installs a domain that knows this witness, and whose verifier finds these defects."""

    def add(name: str, witness: str, defects: str = "()") -> None:
        source = PROVEN.replace("NAME", name).replace("WITNESS", witness).replace("DEFECTS", defects)
        install(f"llm3_{name}", source)

    return add


def test_it_is_a_plan_beside_the_instance_that_verify_finds_sound(command, cwd, proven):
    proven("proven", WHOLE)
    ended = command("instance --domain proven --seed 3 --out problem.json --witness witness.json")
    assert (ended.code, ended.out, ended.err) == (0, "", "")
    assert json.loads((cwd / "problem.json").read_text(encoding="utf-8")) == {"gap": 0.25}
    plan = json.loads((cwd / "witness.json").read_text(encoding="utf-8"))
    assert [step["action"]["params"]["x"] for step in plan["actions"]] == [0.8, 1.2, 1.9]
    assert plan["instance"] == {"gap": 0.25}
    assert command("verify witness.json").out.startswith("sound: 3 actions")


def test_the_instance_goes_to_stdout_as_without_a_witness(command, proven):
    proven("printed", WHOLE)
    alone = command("instance --domain printed --seed 3").out
    assert command("instance --domain printed --seed 3 --witness witness.json").out == alone


def test_a_domain_that_knows_no_solution_says_so(command, cwd):
    ended = command("instance --domain corridor --seed 3 --out problem.json --witness witness.json")
    assert (ended.code, ended.out) == (2, "")
    assert ended.err == "llm3: error: domain 'corridor' knows no solution of setting 'default', seed 3.\n"
    assert list(cwd.iterdir()) == []


@pytest.mark.parametrize(
    ("name", "witness", "defects", "reason"),
    [
        (
            "through_the_wall",
            '(Action("go", (), {"x": 1.0, "y": 0.9}),)',
            "()",
            "go([], {'x': 1.0, 'y': 0.9}): goal in collision (wall)",
        ),
        (
            "half_way",
            f"({THROUGH},)",
            "()",
            "by its last state, the plan misses the goal: the robot is not at the end of the corridor",
        ),
        ("doubted", WHOLE, '(Defect("it is too fast"),)', "it is too fast"),
    ],
)
def test_what_turns_out_to_be_no_solution_is_not_written(command, cwd, proven, name, witness, defects, reason):
    proven(name, witness, defects)
    ended = command(f"instance --domain {name} --seed 3 --out problem.json --witness witness.json")
    assert (ended.code, ended.out) == (3, "")
    known = f"the known solution of {name}/default, seed 3, does not solve this problem"
    assert ended.err == f"llm3: error: {known}: {reason}.\n"
    assert list(cwd.iterdir()) == []


def test_neither_file_is_overwritten_without_force(command, cwd, proven):
    proven("careful", WHOLE)
    (cwd / "witness.json").write_text("mine")
    line = "instance --domain careful --out problem.json --witness witness.json"
    ended = command(line)
    assert (ended.code, ended.out) == (2, "")
    assert ended.err == "llm3: error: 'witness.json' exists: choose another file, or give --force.\n"
    assert [file.name for file in cwd.iterdir()] == ["witness.json"]
    assert command(f"{line} --force").code == 0
    assert command("verify witness.json").code == 0


def test_one_file_cannot_be_both(command):
    ended = command("instance --domain corridor --out a.json --witness ./a.json")
    assert (ended.code, ended.err) == (2, "llm3: error: --out and --witness are both 'a.json': give two files.\n")


def test_the_options_of_the_domain_hold_for_the_witness(command):
    ended = command("instance --domain corridor --witness a.json -D walls=1")
    assert (ended.code, ended.out) == (2, "")
    assert ended.err.startswith("llm3: error: unknown option 'walls' of domain 'corridor'.")
