from __future__ import annotations

import dataclasses
import json

import pytest
from docs_pages import names, page, table, tables

from llm3 import types
from llm3.assembly import RunConfig
from llm3.cli.main import main
from llm3.interfaces import Joint
from llm3.records import PlanFile, RunFile

STRUCTURES = {
    "run.json": RunFile,
    "config": RunConfig,
    "stats": types.Stats,
    "messages": types.Message,
    "completion": types.Completion,
    "proposal": types.Proposal,
    "what is no valid action": types.Rejected,
    "outcome": types.Outcome,
    "failure": types.Failure,
    "contact": types.Contact,
    "goal": types.GoalStatus,
    "feedback": types.Feedback,
    "remark": types.Remark,
    "plan.json": PlanFile,
    "joint": Joint,
    "state": types.State,
    "pose": types.Pose,
    "held": types.Held,
    "step": types.PlannedAction,
    "action": types.Action,
    "motion": types.Motion,
    "segment": types.Segment,
    "trajectory": types.Trajectory,
    "event": types.Event,
}
FILES, EVENTS = "The record of a run", "events.jsonl"


@pytest.mark.parametrize(("heading", "structure"), STRUCTURES.items(), ids=STRUCTURES)
def test_every_field_of_the_record_is_documented_in_order(heading, structure):
    assert table(page("record"), heading).names == tuple(field.name for field in dataclasses.fields(structure))


def test_no_table_is_of_something_else():
    assert {t.heading for t in tables(page("record"))} == {*STRUCTURES, FILES, EVENTS}


def test_every_meaning_is_said():
    for t in tables(page("record")):
        assert all(all(cell for cell in row) for row in t.rows), t.heading


def test_a_run_writes_the_documented_files_and_events(corridor, capsys):
    assert main(["--domain", "corridor", "--out", "record", "--quiet"]) == 0
    folder = corridor / "record"
    assert {file.name for file in folder.iterdir()} == set(table(page("record"), FILES).names)
    first, *lines = [json.loads(line) for line in (folder / "events.jsonl").read_text().splitlines()]
    assert json.dumps(first, separators=(",", ":")) in page("record")
    (corridor / "none.json").write_text("[]")
    assert main(["--domain", "corridor", "--llm", "scripted:none.json", "--out", "failed", "--quiet"]) == 3
    lines += [json.loads(line) for line in (corridor / "failed" / "events.jsonl").read_text().splitlines()[1:]]
    written = {line["event"]: set(line) - {"event", "time"} for line in lines}
    assert written == {row[0].strip("`"): set(names(row[1])) for row in table(page("record"), EVENTS).rows}


def test_the_line_of_a_reused_action_leaves_out_what_stands_where_it_was_tried_first(corridor, capsys):
    go = "go([], {'x': 0.5, 'y': 0.5})"
    (corridor / "replies.json").write_text(json.dumps([json.dumps({"Full Plan": [go]})] * 2))
    assert main(["--domain", "corridor", "--llm", "scripted:replies.json", "--max-llm-calls", "2", "--out", "o"]) == 1
    lines = map(json.loads, (corridor / "o" / "events.jsonl").read_text().splitlines())
    first, second = (line for line in lines if line.get("event") == "ActionTried")
    assert set(first) - set(second) == {"before", "step"}
    assert "The line of a reused action has neither" in page("record")


def test_the_formats_are_named():
    from llm3.records import event_lines, plan, run_file

    for name in (run_file.RUN_FORMAT, event_lines.EVENTS_FORMAT, plan.PLAN_FORMAT):
        assert name in page("record")
