"""The replay of a run: its plan, and where its attempts failed."""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass, field, replace

from llm3.errors import MissingDependency
from llm3.playback import Chapter, frames, replay_page
from llm3.report.cases import Case
from llm3.report.sights import Sights
from llm3.report.story import Story
from llm3.types import FrozenDict, Moment, PlannedAction, State

STILL = 2.0
"""Seconds for which it shows where an attempt failed."""
RATE, MOST = 25.0, 2500
"""How many moments a second it shows of a plan, and how many at most in all."""


@dataclass(frozen=True)
class Replay:
    """A page to be put into another one."""

    page: str = ""
    """Empty where there is nothing to be seen."""
    chapters: Mapping[int, int] = field(default_factory=FrozenDict)
    """By the number of an attempt: the chapter that shows how it failed, counted from 0."""
    note: str = ""
    """What is not installed."""


def replay(story: Story, cases: Sequence[Case], sights: Sights) -> Replay:
    """The replay of a run, as far as its domain has a scenery.

    Args:
        story: The run.
        cases: Its attempts.
        sights: What there is to see.
    """
    if sights.scenery is None or story.start is None:
        return Replay()
    shown = [case for case in cases if case.is_placed]
    title = "The plan" if story.result and story.result.solved else "The last attempt"
    chapters = [Chapter(title, _moments(story.start, story.steps)), *map(_chapter, shown)]
    try:
        page = replay_page(f"Replay of {story.run.config.run_name}", sights.scenery, chapters)
    except MissingDependency as error:
        return Replay(note=str(error))
    return Replay(page, FrozenDict({case.turn.number: index for index, case in enumerate(shown, start=1)}))


def _moments(start: State, steps: tuple[PlannedAction, ...]) -> Iterator[Moment]:
    """What was carried out, in no more moments than a page of a few megabytes holds."""
    *_, last = frames(start, steps, 1.0)
    rate = min(RATE, MOST / max(last.moment.time, 1.0))
    return (frame.moment for frame in frames(start, steps, rate))


def _chapter(case: Case) -> Chapter:
    assert case.evidence  # noqa: S101  # that is why it is shown
    moment, failed = case.evidence.moment, case.turn.failed
    assert failed  # noqa: S101  # so is this
    title = f"Attempt {case.turn.number}, action {failed.index + 1}: {failed.outcome.action}"
    return Chapter(title, (moment, replace(moment, time=moment.time + STILL)), case.evidence.touches)
