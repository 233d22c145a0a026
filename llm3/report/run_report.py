"""The report of a run: one HTML file, which needs no network."""

from __future__ import annotations

from dataclasses import dataclass
from itertools import pairwise
from pathlib import Path

from llm3.records import played_of
from llm3.registry import Registry
from llm3.report.cases import case_drawing, cases, common_window
from llm3.report.glance import asked, spent
from llm3.report.page import render
from llm3.report.pictures import steps
from llm3.report.replay import Replay, replay
from llm3.report.sights import open_sights
from llm3.report.story import read_story
from llm3.report.turn_view import turn_view

IN_FULL = 50
"""Of more attempts than these, only the last ones are told."""


@dataclass(frozen=True)
class Report:
    """A page, and what it could not show."""

    page: str
    notes: tuple[str, ...]
    """What is not installed, a sentence each."""


def run_report(registry: Registry, folder: Path, moving: bool = True) -> Report:
    """Tell a recorded run, also one that goes on or was cut off.

    Args:
        registry: Where its domain comes from.
        folder: The run's record.
        moving: Whether it has pictures of the plan and a replay in three dimensions, which make the page large.

    Raises:
        UnknownName: There is no such domain, or it has no such option.
        InputError: The record does not have the documented form.
    """
    story = read_story(folder)
    played = played_of(registry, folder, story.run, story.start, story.steps)
    turns = story.turns[-IN_FULL:]
    with open_sights(played.domain, played.instance, played.options, story.start, moving) as sights:
        found = tuple(cases(turns, sights.robot))
        window = common_window(story.start, found, sights)
        shown = replay(story, found, sights) if moving else Replay()
        before = {later.number: earlier for earlier, later in pairwise(story.turns)}
        notes = (*sights.notes, *filter(None, (shown.note,)))
        page = render(
            "run.html.jinja",
            story=story,
            asked=tuple(asked(story)),
            spent=tuple(spent(story)),
            steps=tuple(steps(story.start, story.result.plan, sights, window)) if story.result else (),
            turns=[
                turn_view(case, before.get(case.turn.number), case_drawing(case, window, sights), shown.chapters)
                for case in found
            ],
            left_out=len(story.turns) - len(turns),
            replay=shown.page,
            notes=notes,
        )
    return Report(page, notes)
