"""`llm3 execute`: 0 if the goal is reached each time, 1 if it is missed, 2 and 3 for what cannot be carried out."""

from __future__ import annotations

import json

import pytest

MOVING = """\
import numpy as np
from llm3 import hookimpl
from llm3.errors import UsageError
from llm3.interfaces import Executor
from llm3.types import Executed, Execution, Slip, State
from llm3_corridor import Corridor

class Walker(Executor):
    def __init__(self, noise):
        self.noise = noise

    def execute(self, start, actions, rng):
        print("a plugin's chatter")
        if self.noise.angle:
            raise UsageError("it cannot turn.")
        short = abs(float(rng.normal(0.0, self.noise.position)))
        x, y = actions[-1].state.configuration
        slips = (Slip(f"it stopped {short:.1f} m short", {"position": short}),) if short else ()
        done = [Executed(step.action, 1.25, 0.02, 0.01, 0.003, slips) for step in actions]
        return Execution(start, State(configuration=(x - short, y)), tuple(done))

class Moving(Corridor):
    name = "moving"

    def executor(self, instance, options, noise):
        return Walker(noise)

@hookimpl
def llm3_domains():
    return {"moving": Moving}
"""
GO = "{\"Full Plan\": [\"go([], {'x': 1.9, 'y': 0.5})\"]}"
WALK = "action 1 go([], {'x': 1.9, 'y': 0.5}), 1.2 s: "
FIGURES = "(joints off by up to 0.0200, the tool by 3.0 mm)"


@pytest.fixture
def moving(command, install, script):
    """A solved plan of a corridor with a walker, in the folder `run`."""
    install("llm3_moving", MOVING)
    assert command(f"--domain moving --seed 3 {script(GO)} --out run --quiet").code == 0
    return command


def edit(cwd, change):
    """Tamper with the plan."""
    file = cwd / "run/plan.json"
    plan = json.loads(file.read_text(encoding="utf-8"))
    change(plan)
    file.write_text(json.dumps(plan), encoding="utf-8")


def test_a_line_for_each_action_and_one_for_the_end(moving):
    for place in ("run", "run/plan.json"):
        ended = moving(f"execute {place}")
        assert (ended.code, ended.out) == (0, f"{WALK}as planned\ngoal reached {FIGURES}\n")
        assert ended.err == "a plugin's chatter\n"


def test_what_happened_against_the_plan_is_told_and_the_goal_is_missed(moving):
    ended = moving("execute run --position-noise 1 --seed 5")
    assert ended.code == 1
    first, last = ended.out.splitlines()
    assert first.startswith(f"{WALK}it stopped ")
    assert last == f"goal not reached: the robot is not at the end of the corridor {FIGURES}"


def test_many_times_are_a_line_each_and_a_count(moving):
    ended = moving("execute run --position-noise 0.1 --seed 5 --times 6")
    *lines, last = ended.out.splitlines()
    reached = [line for line in lines if f": goal reached {FIGURES}" in line]
    assert [line.partition(":")[0] for line in lines] == [f"seed {seed}" for seed in range(5, 11)]
    assert 0 < len(reached) < 6
    assert (ended.code, last) == (1, f"goal reached in {len(reached)} of 6")


def test_a_seed_is_the_same_alone_and_among_others(moving):
    many = moving("execute run --position-noise 0.1 --seed 5 --times 3 --json")
    alone = moving("execute run --position-noise 0.1 --seed 6 --json")
    assert json.loads(many.out)["executions"][1] == json.loads(alone.out)["executions"][0]
    assert moving("execute run --position-noise 0.1 --seed 6 --json") == alone


def test_an_execution_as_an_object(moving):
    ended = moving("execute run --json")
    state = {"configuration": [0.1, 0.5], "facts": {}, "held": None, "poses": {}}
    action = {"name": "go", "objects": [], "params": {"x": 1.9, "y": 0.5}}
    done = {"action": action, "seconds": 1.25, "joint_error": 0.02, "joint_error_rms": 0.01, "tool_error": 0.003}
    assert ended.code == 0
    assert json.loads(ended.out) == {
        "domain": "moving",
        "noise": {"position": 0.0, "angle": 0.0, "joints": 0.0},
        "times": 1,
        "reached": 1,
        "executions": [
            {
                "seed": 0,
                "goal": {"achieved": True, "unmet": []},
                "start": state,
                "state": {**state, "configuration": [1.9, 0.5]},
                "actions": [{**done, "slips": []}],
                "pose_errors": {},
            }
        ],
    }


def test_control_characters_of_a_plan_do_not_reach_the_terminal(moving, cwd):
    edit(cwd, lambda plan: plan["actions"][0]["action"].update(objects=["\x1b[2J"]))
    ended = moving("execute run")
    assert ended.code == 3
    assert "\x1b" not in ended.out + ended.err


@pytest.mark.parametrize(
    ("arguments", "sentence"),
    [
        ("--angle-noise 0.1", "it cannot turn."),
        (
            "--position-noise -1",
            "argument --position-noise: expected a number from 0 to 1, not '-1'. See 'llm3 execute --help'.",
        ),
        (
            "--joint-noise nan",
            "argument --joint-noise: expected a number from 0 to 1, not 'nan'. See 'llm3 execute --help'.",
        ),
        (
            "--angle-noise much",
            "argument --angle-noise: expected a number from 0 to 1, not 'much'. See 'llm3 execute --help'.",
        ),
        (
            "--times 0",
            "argument --times: expected a whole number from 1 to 10000, not '0'. See 'llm3 execute --help'.",
        ),
        (
            "--seed 9223372036854775807 --times 2",
            "--seed 9223372036854775807 leaves no room for 2 seeds: the largest is 9223372036854775807.",
        ),
    ],
)
def test_what_is_asked_for_in_vain(moving, arguments, sentence):
    ended = moving(f"execute run {arguments}")
    assert (ended.code, ended.out) == (2, "")
    assert ended.err.splitlines()[-1] == f"llm3: error: {sentence}"


def test_a_domain_without_an_executor(command, script):
    assert command(f"--domain corridor --seed 3 {script(GO)} --out run --quiet").code == 0
    ended = command("execute run")
    sentence = "llm3: error: domain 'corridor' has no executor, which 'llm3 execute' needs.\n"
    assert (ended.code, ended.out, ended.err) == (2, "", sentence)


def test_what_is_no_action_is_not_carried_out(moving, cwd):
    edit(cwd, lambda plan: plan["actions"][0]["action"].update(name="fly"))
    sentence = "action 1 fly([], {'x': 1.9, 'y': 0.5}): unknown action 'fly': the actions are go."
    ended = moving("execute run")
    assert (ended.code, ended.out, ended.err) == (3, "", f"llm3: error: {sentence}\n")
