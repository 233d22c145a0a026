"""`--timing`: a plan with times, a plan without, and what is said where a limit is missing."""

from __future__ import annotations

import json

import pytest

JOINTS = """
from llm3 import Joint, hookimpl
from llm3_corridor import Corridor, CorridorEnv

class Limited(CorridorEnv):
    joints = (Joint("x", "m", 1.0, 2.0), Joint("y", "m", {y}))

class {name}(Corridor):
    name = "{name}"
    def make(self, instance, options):
        return Limited(instance)

@hookimpl
def llm3_domains():
    return {{"{name}": {name}}}
"""


@pytest.fixture
def durations(command, cwd, install):
    """Runs a corridor with joints, and answers what was said and how long each piece of its plan takes."""

    def run(name, y, flags=""):
        install(f"llm3_{name}", JOINTS.format(name=name, y=y))
        ended = command(f"--domain {name} --out here {flags}")
        assert ended.code == 0
        plan = json.loads((cwd / "here/plan.json").read_text(encoding="utf-8"))
        segments = [segment for step in plan["actions"] for segment in step["motion"]["segments"]]
        return ended.err, [segment["trajectory"] and segment["trajectory"]["times"][-1] for segment in segments]

    return run


def test_a_plan_has_times_where_the_limits_are_known(durations):
    said, seconds = durations("limited", "1.0, 2.0")
    assert "times" not in said
    assert all(duration > 0 for duration in seconds)


def test_none_leaves_them_out(durations):
    said, seconds = durations("unhurried", "1.0, 2.0", "--timing none")
    assert "times" not in said
    assert not any(seconds)


def test_a_missing_limit_is_told_in_one_line(durations):
    said, seconds = durations("unlimited", "1.0")
    assert said.splitlines()[1] == "the plan will have no times: the domain gives no max_acceleration of y."
    assert not any(seconds)


def test_a_domain_without_joints_is_told_of_only_if_times_were_asked_for(corridor):
    sentence = "the plan will have no times: the domain names no joints."
    assert sentence not in corridor("--out here").err.splitlines()
    assert sentence in corridor("--out there --timing toppra").err.splitlines()


def test_a_missing_package_is_one_line(corridor, monkeypatch):
    monkeypatch.setattr("llm3_time.plugin.find_spec", lambda name: None)
    ended = corridor("--timing toppra --out here")
    assert (ended.code, ended.out) == (3, "")
    assert ended.err == (
        "llm3: error: the timer 'toppra' needs a package that is not installed: pip install 'llm3[time]'.\n"
    )
    assert corridor("--out here").code == 0
