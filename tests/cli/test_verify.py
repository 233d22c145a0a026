"""`llm3 verify`: 0 and one line for a sound plan, 1 and a line for each defect, 2 and 3 for what cannot be checked."""

from __future__ import annotations

import json

import pytest

VERIFIED = """\
from llm3 import hookimpl
from llm3.interfaces import PlanVerifier
from llm3.types import Defect, Verification
from llm3_corridor import Corridor, CorridorEnv, CorridorInstance

class Watchman(PlanVerifier):
    def __init__(self, instance):
        self.gap = instance.gap

    def verify(self, start, actions):
        print("a plugin's chatter")
        found = [
            Defect(f"the wall is hit at y = {y:g} m", number, str(step.action), segment.label, 0.5)
            for number, step in enumerate(actions, start=1)
            for segment in step.motion.segments
            for (x, y) in segment.waypoints
            if abs(x - 1.0) < 0.1 and abs(y - self.gap) > 0.1
        ]
        return Verification(tuple(found), 12, 0.00031)

class Watched(Corridor):
    name = "watched"

    def verifier(self, instance, options):
        return Watchman(instance)

@hookimpl
def llm3_domains():
    return {"watched": Watched}
"""
GO = "{\"Full Plan\": [\"go([], {'x': 1.9, 'y': 0.5})\"]}"


@pytest.fixture
def watched(command, install, script):
    """A solved plan of a corridor with a watchman, in the folder `run`."""
    install("llm3_watched", VERIFIED)
    ended = command(f"--domain watched --seed 3 {script(GO)} --out run --quiet")
    assert ended.code == 0
    return command


def edit(cwd, change):
    """Tamper with the plan."""
    file = cwd / "run/plan.json"
    plan = json.loads(file.read_text(encoding="utf-8"))
    change(plan)
    file.write_text(json.dumps(plan), encoding="utf-8")


def test_a_sound_plan_is_one_line(watched):
    line = "sound: 1 action, 12 configurations looked at, deepest contact 0.31 mm\n"
    for place in ("run", "run/plan.json"):
        ended = watched(f"verify {place}")
        assert (ended.code, ended.out, ended.err) == (0, line, "a plugin's chatter\n")


def test_each_defect_is_a_line(watched, cwd):
    def into_the_wall(plan):
        plan["actions"][0]["motion"]["segments"][0]["waypoints"] = [[0.1, 0.5], [1.0, 0.9], [1.0, 0.05]]
        plan["actions"][0]["state"]["configuration"] = [1.7, 0.5]

    edit(cwd, into_the_wall)
    where = "action 1 go([], {'x': 1.9, 'y': 0.5}), transit, waypoint 0.50"
    ended = watched("verify run")
    assert (ended.code, ended.out) == (
        1,
        f"{where}: the wall is hit at y = 0.9 m\n"
        f"{where}: the wall is hit at y = 0.05 m\n"
        "by its last state, the plan misses the goal: the robot is not at the end of the corridor\n",
    )


def test_a_sound_plan_as_an_object(watched):
    assert json.loads(watched("verify run --json").out) == {
        "sound": True,
        "domain": "watched",
        "actions": 1,
        "configurations": 12,
        "deepest_contact": 0.00031,
        "clearances": {},
        "defects": [],
    }


def test_a_defect_as_an_object(watched, cwd):
    edit(cwd, lambda plan: plan["actions"][0]["action"].update(name="fly"))
    ended = watched("verify run --json")
    assert ended.code == 1
    (defect,) = json.loads(ended.out)["defects"]
    assert defect == {
        "sentence": "unknown action 'fly': the actions are go",
        "number": 1,
        "action": "fly([], {'x': 1.9, 'y': 0.5})",
        "segment": "",
        "waypoint": None,
        "time": None,
        "measures": {},
    }


def test_control_characters_of_a_plan_do_not_reach_the_terminal(watched, cwd):
    edit(cwd, lambda plan: plan["actions"][0]["action"].update(objects=["\x1b[2J"]))
    assert "\x1b" not in watched("verify run").out


def test_another_instance_is_another_problem(watched, cwd):
    def through_the_gap(plan):
        plan["actions"][0]["motion"]["segments"][0]["waypoints"] = [[0.1, 0.5], [1.0, 0.25], [1.9, 0.5]]

    edit(cwd, through_the_gap)
    assert watched("verify run").code == 0
    edit(cwd, lambda plan: plan["instance"].update(gap=0.7))
    where = "action 1 go([], {'x': 1.9, 'y': 0.5}), transit, waypoint 0.50"
    ended = watched("verify run")
    assert (ended.code, ended.out) == (1, f"{where}: the wall is hit at y = 0.25 m\n")


@pytest.mark.parametrize(
    ("change", "code", "sentence"),
    [
        (
            lambda plan: plan.update(domain="wached"),
            2,
            "unknown domain 'wached'; did you mean 'watched'? Known: blocks, boxpack, corridor, kitchen, tabletop2d, "
            "watched.",
        ),
        (
            lambda plan: plan.update(options={"walls": "1"}),
            2,
            "unknown option 'walls' of domain 'watched'. Known: none.",
        ),
        (lambda plan: plan.update(instance={}), 3, "the plan's instance: Object missing required field `gap`"),
        (
            lambda plan: plan.update(format="llm3-plan/9"),
            3,
            "run/plan.json: the format is 'llm3-plan/9', and this version reads 'llm3-plan/1'",
        ),
        (lambda plan: plan.pop("start"), 3, "run/plan.json: Object missing required field `start`"),
        (
            lambda plan: plan.update(joints=[{"name": "leg", "unit": "m"}]),
            3,
            "the plan is for a robot with the joints leg (m), but the robot has none.",
        ),
        (
            lambda plan: plan["actions"][0]["motion"]["segments"][0].update(waypoints=[]),
            3,
            "the plan has no waypoints in segment 'transit' of action 1.",
        ),
        (
            lambda plan: plan["actions"][0]["state"].update(configuration=[1.9]),
            3,
            "the plan has 1 joint values in the state after action 1, and the robot needs 2.",
        ),
        (lambda plan: plan["start"].update(configuration=[float("nan"), 0.5]), 3, None),
        (
            lambda plan: plan.update(domain="corridor"),
            2,
            "domain 'corridor' has no verifier, which 'llm3 verify' needs.",
        ),
    ],
)
def test_what_cannot_be_checked_is_one_line(watched, cwd, change, code, sentence):
    edit(cwd, change)
    ended = watched("verify run")
    assert (ended.code, ended.out) == (code, "")
    assert ended.err.startswith("llm3: error: ")
    assert ended.err.count("\n") == 1
    assert sentence is None or ended.err == f"llm3: error: {sentence}\n"


def test_a_run_that_was_not_solved_has_no_plan(command, cwd):
    (cwd / "empty").mkdir()
    ended = command("verify empty")
    sentence = "empty holds neither plan.json nor run.json: it is no folder of a run."
    assert (ended.code, ended.err) == (3, f"llm3: error: {sentence}\n")
    ended = command("verify nowhere.json")
    assert (ended.code, ended.err) == (3, "llm3: error: nowhere.json: No such file or directory\n")


def test_a_plan_must_be_named(command):
    ended = command("verify")
    assert (ended.code, ended.err) == (
        2,
        "llm3: error: the following arguments are required: PLAN. See 'llm3 verify --help'.\n",
    )
    assert command("verify a.json b.json").code == 2


def test_a_run_is_no_plan(watched):
    ended = watched("verify run/run.json")
    assert (ended.code, ended.err) == (
        3,
        "llm3: error: run/run.json: the format is 'llm3-run/1', and this version reads 'llm3-plan/1'\n",
    )


def test_a_problem_is_no_plan(watched, cwd):
    assert watched("instance --domain watched --out problem.json").code == 0
    ended = watched("verify problem.json")
    assert (ended.code, ended.err) == (
        3,
        "llm3: error: problem.json: no format is stated, and this version reads 'llm3-plan/1'\n",
    )


def test_times_for_some_segments_only_are_a_defect(watched, cwd):
    def half_timed(plan):
        (segment,) = plan["actions"][0]["motion"]["segments"]
        still = {"times": [0.0], "positions": segment["waypoints"][-1:], "velocities": [[0.0, 0.0]]}
        after = {"label": "stay", "waypoints": segment["waypoints"][-1:], "trajectory": still}
        plan["actions"][0]["motion"]["segments"].append(after)

    edit(cwd, half_timed)
    ended = watched("verify run")
    assert (ended.code, ended.out) == (
        1,
        "action 1 go([], {'x': 1.9, 'y': 0.5}), transit: it has no times, and other segments have\n",
    )
