"""`--solver search`: a search in place of a model."""

from __future__ import annotations

import json
from pathlib import Path

import pytest

from llm3.cli.view import RunView
from llm3.types import Attempt, GoalStatus, Result, State, Stats


@pytest.fixture
def found(corridor, cwd):
    """What a search of the corridor printed, and its record."""
    return corridor("--solver search --seed 3 --out here"), json.loads((cwd / "here/run.json").read_text())


def test_a_search_prints_its_plan_and_shows_each_new_action_once(found):
    ended, record = found
    assert ended.code == 0
    notice, *story, summary, folder = ended.err.splitlines()
    assert notice == "No language model is used: a search tries actions with parameters drawn at random."
    assert all(" go([], {" in line and not line.endswith("(known)") for line in story)
    assert len(story) == record["stats"]["motion_calls"]
    assert ended.out.splitlines()[-1] in story[-1]
    tried = f"{len(story) + 1} plans, {len(story)} motion calls"  # the first plan is to do nothing
    assert summary.startswith("solved in ")
    assert summary.endswith(f"{tried}, {record['stats']['reused_actions']} actions reused")
    assert folder == "record: here"


def test_the_record_says_that_it_was_a_search_and_what_limited_it(found):
    _, record = found
    config = record["config"]
    assert (record["language_model"], record["stop"], record["stats"]["llm_calls"]) == (False, "solved", 0)
    assert (config["solver"], config["llm"], config["model"]) == ("search", None, None)
    assert (config["max_motion_calls"], config["max_seconds"]) == (2000, None)
    assert set(record["plugins"]) == {"domain/corridor", "planner/birrt", *filter(_is_timer, record["plugins"])}


def _is_timer(name):
    return name.startswith("timer/")


def test_the_json_names_no_method_of_a_model(corridor):
    told = json.loads(corridor("--solver search --json --out here").out)
    assert told["solver"] == "search"
    assert [told[key] for key in ("strategy", "feedback", "llm", "model")] == [None] * 4


@pytest.mark.parametrize("solver", ["search", "loop --llm scripted:replies.json"])
def test_a_budget_of_motion_calls_that_is_used_up_is_told(corridor, cwd, solver):
    steps = [f"""{{"Full Plan": ["go([], {{'x': 0.{step}, 'y': 0.5}})"]}}""" for step in (1, 2, 3, 4, 5)]
    (cwd / "replies.json").write_text(json.dumps(steps))
    ended = corridor(f"--seed 5 --solver {solver} --max-motion-calls 3 --out here --json")
    told = json.loads(ended.out)
    assert (ended.code, told["stop"], told["motion_calls"]) == (1, "motions", 3)
    assert "the budget of motion calls is used up" in ended.err.splitlines()


@pytest.mark.parametrize(
    ("flags", "sentence"),
    [
        ("--solver serach", "unknown solver 'serach'; did you mean 'search'? Known: loop, search."),
        ("--solver search --model gpt", "the solver 'search' asks no model: leave out --model."),
        ("--solver search --max-tokens-total 9", "the solver 'search' asks no model: leave out --max-tokens-total."),
        ("--max-motion-calls 0", "the number of motion calls must be at least 1, not 0."),
    ],
)
def test_what_a_search_cannot_do_is_one_line(corridor, flags, sentence):
    ended = corridor(flags)
    assert (ended.code, ended.out, ended.err) == (2, "", f"llm3: error: {sentence}\n")


@pytest.mark.parametrize(
    ("stop", "sentence"),
    [
        ("motions", "the budget of motion calls is used up"),
        ("seconds", "the budget of seconds is used up"),
        ("attempts", "the search made very many attempts with hardly any motion"),
        ("exhausted", "everything that can be done was tried, and nothing reached the goal"),
    ],
)
def test_the_summary_says_why_a_search_gave_up(capsys, stop, sentence):
    goal = GoalStatus(False, ("the robot is not there",))
    result = Result(False, (), goal, (Attempt(1, goal),), Stats(motion_calls=4), State(), stop)
    RunView(quiet=False, budget=None).summary(result, 0.04, Path("here"))
    assert capsys.readouterr().err.splitlines() == [
        "not solved in 0.0 s: 1 plan, 4 motion calls, 0 actions reused",
        sentence,
        "record: here",
    ]
