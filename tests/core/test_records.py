"""What a run leaves on disk, however it ends."""

import json
import os
import subprocess
import sys
from dataclasses import replace
from datetime import datetime

import pytest
from line_world import (
    FINISH,
    Line,
    LineInstance,
    TickingClock,
    go,
    line_registry,
    reply,
    take,
)

from llm3.assembly import RunConfig, assemble
from llm3.errors import BackendError, InputError, LLM3Error, OutputExists
from llm3.records import Recorder, create_default_folder, create_folder, read_plan
from llm3.testing import ScriptedLLM
from llm3.types import (
    Completion,
    Event,
    EventKind,
    FailureKind,
    Goal,
    Pose,
    Segment,
    Stats,
)

CONFIG = RunConfig("line", llm="scripted:replies.json", options={"ground": "wet"}, seed=5, max_llm_calls=3)
SOLVES = [reply(go(5)), "no plan", reply(go(1), take("coin"), go(FINISH), "dance()")]


class RoughLine(Line):
    """A line with a wall, and with a wheel that is locked for a while and grips the coin."""

    def __init__(self):
        super().__init__(trouble={5: FailureKind.GOAL_IN_COLLISION}, slippery={8.0: 1.0})

    def prepare(self, state, action, rng):
        problem = super().prepare(state, action, rng)
        if action == go(FINISH):
            lock = Segment("lock", ((FINISH,),), (Event(EventKind.GRIPPER, opening=0.04), GRASP))
            problem = replace(problem, goals=(Goal((FINISH,), (lock,)),))
        return problem


GRASP = Event(EventKind.ATTACH, object="coin", grasp=Pose((0, 0, 0.01)))


def make_run(script, env=None):
    run = assemble(line_registry(), replace(CONFIG, domain="full-line", llm="random"), LineInstance(0.0))
    solver = replace(run.solver, backend=ScriptedLLM(script))
    run = replace(run, config=replace(CONFIG, setting="far"), solver=solver)
    return replace(run, problem=replace(run.problem, env=env or RoughLine()))


def record(folder, script, watch=lambda event: None, clock=None):
    """Solve with these replies, recorded; whatever ends the run is raised."""
    run = make_run(script)
    with Recorder(folder, run, clock or TickingClock()) as recorder:
        return run.solve(lambda event: (recorder(event), watch(event)))


def run_file(folder):
    return json.loads((folder / "run.json").read_text(encoding="utf-8"))


def events(folder):
    return [json.loads(line) for line in (folder / "events.jsonl").read_text(encoding="utf-8").splitlines()]


# ---- how a run ended -----------------------------------------------------------------------------------------------


def test_a_solved_run(tmp_path):
    result = record(tmp_path, SOLVES)
    assert result.solved
    found = run_file(tmp_path)
    assert found["format"] == "llm3-run/1"
    assert found["status"] == "solved"
    assert found["config"] == {
        "domain": "line",
        "setting": "far",
        "seed": 5,
        "solver": "loop",
        "strategy": "backtrack",
        "feedback": "categorized",
        "llm": "scripted:replies.json",
        "model": None,
        "temperature": None,
        "planner": "birrt",
        "planner_iterations": 2000,
        "planner_seconds": 30.0,
        "timing": None,
        "max_llm_calls": 3,
        "trace_size": 5,
        "max_reply_tokens": None,
        "max_tokens_total": None,
        "max_seconds": None,
        "max_motion_calls": None,
        "options": {"ground": "wet"},
    }
    assert found["instance"] == {"start": 0.0}
    assert found["options"] == {"ground": "wet", "colour": "red"}
    assert found["language_model"] is False
    assert found["notice"] == "No language model is used: the replies come from a script."
    assert set(found["versions"]) == {"python", "platform", "llm3", "numpy", "scipy", "pybullet", "ompl", "toppra"}
    assert found["plugins"] == {
        "domain/full-line": "line (test)",
        "planner/birrt": "line (test)",
        "strategy/backtrack": "templates (test)",
        "feedback/categorized": "line (test)",
        "backend/random": "standins (test)",
    }
    assert (found["stats"]["llm_calls"], found["stats"]["motion_calls"]) == (3, 3)
    assert (found["unmet"], found["error"], found["time_limited"]) == ([], "", False)
    assert found["seconds"] > 0
    assert {path.name for path in tmp_path.iterdir()} == {"run.json", "events.jsonl", "plan.json"}


def test_a_run_that_is_not_solved(tmp_path):
    result = record(tmp_path, [reply(go(1))] * 3)
    assert not result.solved
    found = run_file(tmp_path)
    assert found["status"] == "not solved"
    assert found["unmet"] == ["the robot is not at the finish"]
    assert (found["stats"]["llm_calls"], found["stats"]["motion_calls"], found["stats"]["reused_actions"]) == (3, 1, 2)
    assert not (tmp_path / "plan.json").exists()
    with pytest.raises(InputError) as caught:
        read_plan(tmp_path)
    assert str(caught.value) == f"{tmp_path} holds no plan.json: the run was not solved, or has not ended."


@pytest.mark.parametrize(
    ("ending", "status", "error"),
    [
        (BackendError("no server answers at http://x."), "error", "no server answers at http://x."),
        (KeyboardInterrupt(), "interrupted", ""),
    ],
)
def test_whatever_ends_a_run_passes_through_and_leaves_the_record_whole(tmp_path, ending, status, error):
    paid = Completion(reply(go(1)), Stats(prompt_tokens=30, completion_tokens=4))
    with pytest.raises(type(ending)):
        record(tmp_path, [paid, ending])
    found = run_file(tmp_path)
    assert (found["status"], found["error"]) == (status, error)
    assert found["unmet"] == ["the robot is not at the finish"]
    stats = found["stats"]
    assert (stats["llm_calls"], stats["motion_calls"], stats["prompt_tokens"]) == (1, 1, 30)
    ended = ["PromptSent", "CallFailed"] if isinstance(ending, BackendError) else ["AttemptEnded", "PromptSent"]
    assert [event.get("event") for event in events(tmp_path)][-2:] == ended


def test_a_reply_is_paid_for_also_if_its_attempt_never_ends(tmp_path):
    def stop(event):
        if type(event).__name__ == "ActionTried":
            raise KeyboardInterrupt

    paid = Completion(reply(go(1)), Stats(prompt_tokens=30, completion_tokens=4))
    with pytest.raises(KeyboardInterrupt):
        record(tmp_path, [paid], stop)
    stats = run_file(tmp_path)["stats"]
    assert (stats["llm_calls"], stats["prompt_tokens"], stats["completion_tokens"]) == (1, 30, 4)


def test_a_package_that_is_not_there_has_no_version(tmp_path, monkeypatch):
    monkeypatch.setattr("llm3.records.run_file.VERSIONED", ("llm3", "no-such-package"))
    record(tmp_path, SOLVES)
    versions = run_file(tmp_path)["versions"]
    assert set(versions) == {"python", "platform", "llm3", "no-such-package"}
    assert versions["no-such-package"] == "not installed"


def test_while_a_run_goes_on_its_record_says_so(tmp_path):
    statuses = []
    record(tmp_path, SOLVES, lambda event: statuses.append(run_file(tmp_path)["status"]))
    assert set(statuses) == {"running"}


# ---- the events ----------------------------------------------------------------------------------------------------


def test_every_prompt_reply_action_outcome_and_feedback_is_in_the_events(tmp_path):
    record(tmp_path, SOLVES)
    head, *lines = events(tmp_path)
    assert head == {"format": "llm3-events/1"}
    first, middle = ["PromptSent", "ReplyReceived", "ReplyRead", "ActionTried", "AttemptEnded"], "PromptSent"
    assert [line["event"] for line in lines] == [
        "RunStarted",
        *first,
        *[middle, "ReplyReceived", "ReplyRead", "AttemptEnded"],
        *[*first[:4], "ActionTried", "ActionTried", "ActionTried", "AttemptEnded"],
        "RunEnded",
    ]
    assert lines[0]["state"]["configuration"] == [0.0]
    assert [message["role"] for message in lines[1]["messages"]] == ["system", "user"]
    assert lines[2]["completion"]["text"] == SOLVES[0]
    assert lines[3]["proposal"]["actions"] == [{"name": "go", "objects": [], "params": {"x": 5.0}}]
    assert lines[4]["outcome"]["failure"]["kind"] == "goal in collision"
    assert lines[4]["outcome"]["failure"]["objects"] == ["wall"]
    assert lines[5]["goal"] == {"achieved": False, "unmet": ["the robot is not at the finish"]}
    assert lines[5]["feedback"]["remarks"][0]["text"] == "goal in collision"
    assert lines[8]["proposal"]["kind"] == "unreadable reply"
    assert lines[-3]["outcome"]["failure"]["kind"] == "invalid action"
    assert lines[-2]["feedback"] is None
    assert lines[-1]["solved"] is True
    assert lines[-1]["stats"] == run_file(tmp_path)["stats"]


def test_what_the_model_reads_is_in_the_record_to_the_letter(tmp_path):
    run = make_run(SOLVES)
    with Recorder(tmp_path, run, TickingClock()) as recorder:
        run.solve(recorder)
    sent = [line["messages"] for line in events(tmp_path) if line.get("event") == "PromptSent"]
    asked = [[{"role": m.role, "content": m.content} for m in r.messages] for r in run.solver.backend.requests]
    assert sent == asked


def test_every_event_is_on_disk_as_soon_as_it_has_happened(tmp_path):
    seen = []

    def watch(event):
        seen.append(type(event).__name__)
        assert [line.get("event") for line in events(tmp_path)] == [None, *seen]

    record(tmp_path, SOLVES, watch)
    assert len(seen) > 10


def test_times_are_seconds_since_the_record_began_and_only_grow(tmp_path):
    record(tmp_path, SOLVES, clock=TickingClock())
    times = [line["time"] for line in events(tmp_path)[1:]]
    assert times == sorted(times)
    assert times[0] >= 1.0


# ---- the plan ------------------------------------------------------------------------------------------------------


def test_a_plan_holds_all_that_is_needed_to_check_it_again(tmp_path):
    result = record(tmp_path, SOLVES)
    plan = json.loads((tmp_path / "plan.json").read_text(encoding="utf-8"))
    assert list(plan) == ["format", "domain", "instance", "options", "joints", "start", "actions"]
    assert (plan["format"], plan["domain"], plan["instance"]) == ("llm3-plan/1", "full-line", {"start": 0.0})
    assert plan["options"] == {"ground": "wet", "colour": "red"}
    limits = dict.fromkeys(("max_velocity", "max_acceleration", "min_position", "max_position"))
    assert plan["joints"] == [{"name": "wheel", "unit": "m", **limits}]
    assert plan["start"]["configuration"] == [0.0]
    assert [step["action"]["name"] for step in plan["actions"]] == ["go", "take", "go"]
    roll, lock = plan["actions"][2]["motion"]["segments"]
    assert roll["label"] == "transit"
    assert (roll["waypoints"][0], roll["waypoints"][-1]) == ([1.0], [FINISH])
    assert [event["kind"] for event in lock["events"]] == ["gripper", "attach"]
    assert lock["events"][0]["opening"] == 0.04
    assert lock["events"][1]["object"] == "coin"
    assert lock["events"][1]["grasp"]["position"] == [0.0, 0.0, 0.01]
    assert plan["actions"][2]["state"]["configuration"] == [FINISH]
    assert plan["actions"][1]["motion"]["segments"] == []
    assert read_plan(tmp_path) == read_plan(tmp_path / "plan.json")
    assert read_plan(tmp_path).actions == result.plan
    assert read_plan(tmp_path).start == result.start


def test_a_plan_names_no_time_folder_or_backend(tmp_path):
    record(tmp_path, SOLVES)
    text = (tmp_path / "plan.json").read_text(encoding="utf-8")
    assert not any(word in text for word in ("scripted", "seconds", "time", "seed", tmp_path.name, "stats"))


def test_a_plan_can_be_carried_out_again_from_the_file_alone(tmp_path):
    record(tmp_path, SOLVES)
    plan = read_plan(tmp_path)
    env, state = RoughLine(), plan.start
    for step in plan.actions:
        state = env.apply(state, step.action, step.motion).state
        assert state == step.state
    assert env.goal(state).achieved


@pytest.mark.parametrize(
    ("change", "wrong"),
    [
        ({"format": "llm3-plan/9"}, "the format is 'llm3-plan/9', and this version reads 'llm3-plan/1'"),
        ({"format": None}, "no format is stated, and this version reads 'llm3-plan/1'"),
        ({"joints": None}, "Expected `array`, got `null` - at `$.joints`"),
        (
            {"backend": "http"},
            "unknown field `backend`, expected format, domain, instance, options, joints, start, actions - at `$`",
        ),
    ],
)
def test_a_plan_in_another_form_is_refused(tmp_path, change, wrong):
    record(tmp_path, SOLVES)
    path = tmp_path / "plan.json"
    path.write_text(json.dumps({**json.loads(path.read_text(encoding="utf-8")), **change}), encoding="utf-8")
    with pytest.raises(InputError) as caught:
        read_plan(tmp_path)
    assert str(caught.value) == f"{path}: {wrong}"


# ---- the same run again --------------------------------------------------------------------------------------------

PROGRAM = """
import sys
from pathlib import Path
import test_records
test_records.record(Path(sys.argv[1]), test_records.SOLVES)
"""
CUT_OFF = """
import os, sys
from pathlib import Path
import test_records
stop = lambda request: os._exit(9) if len(request.context.trace) else test_records.reply(test_records.go(1))
test_records.record(Path(sys.argv[1]), stop)
"""


def in_another_process(program, folder, hash_seed="0"):
    surroundings = {**os.environ, "PYTHONHASHSEED": hash_seed, "PYTHONPATH": os.pathsep.join(sys.path)}
    return subprocess.run(
        [sys.executable, "-W", "error", "-c", program, str(folder)], env=surroundings, capture_output=True, text=True
    )


def without_times(value):
    if isinstance(value, dict):
        return {key: without_times(item) for key, item in value.items() if key not in ("time", "seconds")}
    return [without_times(item) for item in value] if isinstance(value, list) else value


def test_the_same_seed_and_replies_give_the_same_bytes_also_in_another_process(tmp_path):
    folders = [create_folder(tmp_path / name) for name in ("here", "one", "two")]
    record(folders[0], SOLVES)
    for folder, hash_seed in zip(folders[1:], ("1", "2"), strict=True):
        done = in_another_process(PROGRAM, folder, hash_seed)
        assert (done.returncode, done.stdout, done.stderr) == (0, "", "")
    assert len({(folder / "plan.json").read_bytes() for folder in folders}) == 1
    assert without_times(events(folders[0])) == without_times(events(folders[1])) == without_times(events(folders[2]))


def test_a_process_that_is_killed_leaves_what_had_happened(tmp_path):
    assert in_another_process(CUT_OFF, tmp_path).returncode == 9
    assert [line.get("event") for line in events(tmp_path)][-2:] == ["AttemptEnded", "PromptSent"]
    assert run_file(tmp_path)["status"] == "running"


# ---- folders -------------------------------------------------------------------------------------------------------


def test_the_default_folder_is_named_by_time_and_problem_and_is_new(tmp_path):
    now = datetime(2026, 3, 4, 15, 6, 7)
    folder = create_default_folder("boxpack-hard-small-0", now, tmp_path)
    assert folder == tmp_path / "20260304-150607-boxpack-hard-small-0"
    create_folder(folder)
    second = create_default_folder("boxpack-hard-small-0", now, tmp_path)
    assert second == tmp_path / "20260304-150607-boxpack-hard-small-0-2"
    create_folder(second)
    assert create_default_folder("boxpack-hard-small-0", now, tmp_path).name.endswith("-0-3")


def test_a_folder_is_made_with_its_parents_and_an_empty_one_will_do(tmp_path):
    folder = tmp_path / "a" / "b"
    assert create_folder(folder) == folder
    assert create_folder(folder).is_dir()


def test_a_folder_that_holds_something_is_left_alone_without_force(tmp_path):
    (tmp_path / "notes.txt").write_text("mine", encoding="utf-8")
    with pytest.raises(OutputExists) as caught:
        create_folder(tmp_path)
    assert str(caught.value) == f"the output folder '{tmp_path}' is not empty: choose another, or give --force."
    assert [path.name for path in tmp_path.iterdir()] == ["notes.txt"]


def test_force_takes_away_an_earlier_record_and_nothing_else(tmp_path):
    (tmp_path / "notes.txt").write_text("mine", encoding="utf-8")
    record(tmp_path, SOLVES)
    create_folder(tmp_path, force=True)
    assert [path.name for path in tmp_path.iterdir()] == ["notes.txt"]
    record(tmp_path, [reply(go(1))] * 3)
    assert not (tmp_path / "plan.json").exists()


def test_a_folder_that_cannot_be_made_is_named(tmp_path):
    blocked = tmp_path / "file"
    blocked.write_text("", encoding="utf-8")
    with pytest.raises(LLM3Error) as caught:
        create_folder(blocked)
    assert str(caught.value) == f"'{blocked}' is a file, not a folder: choose another."
    with pytest.raises(LLM3Error) as caught:
        create_folder(blocked / "below")
    assert str(caught.value) == f"the output folder '{blocked / 'below'}' cannot be written: Not a directory."


def test_a_folder_in_the_place_of_a_record_is_named_before_anything_is_taken_away(tmp_path):
    (tmp_path / "run.json").write_text("{}", encoding="utf-8")
    (tmp_path / "plan.json").mkdir()
    with pytest.raises(LLM3Error) as caught:
        create_folder(tmp_path, force=True)
    assert str(caught.value) == f"'{tmp_path / 'plan.json'}' is a folder, so no record can be written there."
    assert (tmp_path / "run.json").exists()


def test_a_default_folder_that_cannot_be_made_is_named(tmp_path):
    blocked = tmp_path / "runs"
    blocked.write_text("", encoding="utf-8")
    with pytest.raises(LLM3Error) as caught:
        create_default_folder("x", datetime(2026, 3, 4, 15, 6, 7), blocked)
    folder = blocked / "20260304-150607-x"
    assert str(caught.value) == f"the output folder '{folder}' cannot be written: Not a directory."
