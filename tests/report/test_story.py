"""A story tells what the events of a record tell, turn by turn."""

from __future__ import annotations

import pytest
from reported import record

from llm3.assembly import RunConfig
from llm3.records import read_events
from llm3.report import read_story
from llm3.types import ActionTried, AttemptEnded, PromptSent, ReplyReceived

CLUTTER = RunConfig("tabletop2d", "clutter", llm="random", timing="none", max_llm_calls=4)


@pytest.fixture(scope="module", params=["random", "offline"])
def folder(request, tmp_path_factory):
    from dataclasses import replace

    return record(tmp_path_factory.mktemp("run"), replace(CLUTTER, llm=request.param))


def events(folder, kind):
    return [recorded.event for recorded in read_events(folder) if isinstance(recorded.event, kind)]


def test_every_turn_has_its_prompt_its_reply_and_its_ending(folder):
    turns = read_story(folder).turns
    assert [turn.number for turn in turns] == list(range(1, len(turns) + 1))
    assert [turn.messages for turn in turns] == [event.messages for event in events(folder, PromptSent)]
    assert [turn.completion for turn in turns] == [event.completion for event in events(folder, ReplyReceived)]
    assert [turn.ended for turn in turns] == events(folder, AttemptEnded)


def test_every_action_is_told_once_in_order(folder):
    tried = [tried for turn in read_story(folder).turns for tried in turn.tried]
    assert tried == events(folder, ActionTried)


def test_what_was_planned_was_tried_or_was_not(folder):
    for turn in read_story(folder).turns:
        assert (*(tried.outcome.action for tried in turn.tried), *turn.untried) == turn.reading.actions
        assert turn.failed is None or turn.failed == turn.tried[-1]


def test_the_plan_is_what_is_played_or_what_the_last_attempt_carried_out(folder):
    story = read_story(folder)
    expected = story.result.plan if story.result.solved else story.turns[-1].steps
    assert story.steps == expected


def test_of_a_run_that_was_cut_off_all_is_told_up_to_there(folder, tmp_path):
    whole = (folder / "events.jsonl").read_text().splitlines(keepends=True)
    (tmp_path / "run.json").write_text((folder / "run.json").read_text())
    turns = read_story(folder).turns
    for count in range(1, len(whole) + 1):
        (tmp_path / "events.jsonl").write_text("".join(whole[:count]))
        story = read_story(tmp_path)
        assert (story.result is None) == (count < len(whole))
        assert [turn.number for turn in story.turns] == [turn.number for turn in turns][: len(story.turns)]
        assert story.turns[:-1] == turns[: max(0, len(story.turns) - 1)]
