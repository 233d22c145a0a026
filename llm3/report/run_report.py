"""The report of a run: one HTML file, which needs no network."""

from __future__ import annotations

from collections.abc import Iterator
from contextlib import ExitStack
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
from llm3.report.sights import UNSEEN, open_sights
from llm3.report.story import Story, read_story
from llm3.report.turn_view import turn_view
from llm3.types import State

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
    played = played_of(registry, folder, story.run, story.start or State(), story.steps)
    turns = story.turns[-IN_FULL:]
    with ExitStack() as stack:
        sights = UNSEEN
        if story.start is not None:
            sights = open_sights(played.domain, played.instance, played.options, story.start, moving)
            stack.enter_context(sights)
        found = tuple(cases(turns, sights.robot))
        window = common_window(played.start, found, sights)
        shown = replay(story, found, sights) if moving else Replay()
        before = {later.number: earlier for earlier, later in pairwise(story.turns)}
        missing = (*sights.notes, *filter(None, (shown.note,)))
        page = render(
            "run.html.jinja",
            story=story,
            asked=tuple(asked(story)),
            spent=tuple(spent(story)),
            steps=tuple(steps(played.start, story.result.plan, sights, window)) if story.result else (),
            turns=[
                turn_view(case, before.get(case.turn.number), case_drawing(case, window, sights), shown.chapters)
                for case in found
            ],
            left_out=len(story.turns) - len(turns),
            replay=shown.page,
            missing=missing,
            remarks=tuple(_remarks(story, moving)),
        )
    return Report(page, missing)


def _remarks(story: Story, moving: bool) -> Iterator[str]:
    """What readers have to know of a record, or a report, that is not whole."""
    if story.run.status == "running":
        yield "The run had not ended when this was written, or it was killed: figures are those of its last attempt."
    elif story.run.status in ("solved", "not solved") and story.result is None:
        yield f"The record is damaged: run.json says {story.run.status!r}, and the events break off before the end."
    if not moving:
        yield "This is a small report, without pictures of the plan and without a replay."
