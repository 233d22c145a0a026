"""`llm3 verify` as a shell runs it, on a plan of the box-packing task."""

from __future__ import annotations

import json
import re

import pytest
from command_line import Ended, environment, llm3, run


@pytest.fixture(scope="module")
def folder(tmp_path_factory):
    """A folder in which a run left a plan."""
    place = tmp_path_factory.mktemp("verified")
    assert run(llm3("--domain boxpack --setting easy-small --out run --quiet"), place, environment()).code == 0
    return place


def verify(folder, name: str = "run") -> Ended:
    return run(llm3(f"verify {name}"), folder, environment())


def tampered(folder, name: str, change) -> str:
    """Another plan beside it."""
    plan = json.loads((folder / "run/plan.json").read_text(encoding="utf-8"))
    change(plan)
    (folder / name).write_text(json.dumps(plan), encoding="utf-8")
    return name


def test_a_solved_plan_is_sound_twice_alike(folder):
    ended = verify(folder)
    assert (ended.code, ended.err) == (0, "")
    assert re.fullmatch(r"sound: 8 actions, [\d,]+ configurations looked at, deepest contact 0\.\d\d mm\n", ended.out)
    assert verify(folder) == ended


def test_a_dropped_action_is_told_on_stdout(folder):
    def drop(plan):
        del plan["actions"][6:]

    ended = verify(folder, tampered(folder, "short.json", drop))
    assert (ended.code, ended.err) == (1, "")
    own, last = ended.out.splitlines()
    box = own.partition(" ")[0]
    assert re.fullmatch(r"\w+_box ends \d+\.\d mm out of the basket", own)
    assert last == f"by its last state, the plan misses the goal: {box} is not in the basket"


def test_another_instance_is_another_problem(folder):
    def move(plan):
        plan["instance"]["boxes"][0]["position"][1] += 0.01

    ended = verify(folder, tampered(folder, "moved.json", move))
    assert (ended.code, ended.err) == (1, "")
    (line,) = ended.out.splitlines()
    assert line.startswith("the plan does not start where the problem does: the pose of red_box is {")


def test_another_robot_is_refused(folder):
    ended = verify(folder, tampered(folder, "robot.json", lambda plan: plan["options"].update(robot="iiwa")))
    assert (ended.code, ended.out) == (3, "")
    assert ended.err.startswith("llm3: error: the plan is for a robot with the joints panda_joint1 (rad), ")
    assert ended.err.endswith(", lbr_iiwa_joint_7 (rad).\n")


def test_a_robot_that_nobody_knows_is_a_usage_error(folder):
    ended = verify(folder, tampered(folder, "unknown.json", lambda plan: plan["options"].update(robot="pandora")))
    assert (ended.code, ended.out) == (2, "")
    assert ended.err.startswith("llm3: error: unknown robot 'pandora'; did you mean 'panda'? Known: iiwa, panda.")
