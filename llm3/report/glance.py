"""What a run was, and what it took, in a few figures."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass

from llm3.report.story import Story
from llm3.wording import ENDINGS, counted


@dataclass(frozen=True)
class Fact:
    """Something to be read at a glance."""

    name: str
    value: str


def asked(story: Story) -> Iterator[Fact]:
    """What was asked."""
    run, config = story.run, story.run.config
    yield Fact("Problem", f"{config.domain}, {config.setting or 'from a file'}, seed {config.seed}")
    yield from (Fact(f"Option {name}", value) for name, value in run.options.items())
    if config.is_search:
        yield Fact("Solver", "search, which asks no model")
    else:
        yield Fact("Model", config.model or f"none: {config.backend} is no language model")
        yield Fact("Strategy", config.strategy)
        yield Fact("Feedback", config.feedback)
    yield Fact("Motion planner", config.planner)
    yield Fact("Versions", ", ".join(f"{name} {version}" for name, version in run.versions.items()))


def spent(story: Story) -> Iterator[Fact]:
    """What it took, and why it ended."""
    run, stats, seconds = story.run, story.stats, story.seconds
    yield Fact("Attempts", f"{len(story.turns):,}")
    yield Fact("Model calls", f"{stats.llm_calls:,}")
    if stats.tokens:
        yield Fact("Tokens", f"{stats.prompt_tokens:,} read, {stats.completion_tokens:,} written")
    if stats.retries or stats.step_downs:
        yield Fact("Requests made again", f"{stats.retries + stats.step_downs:,}")
    yield Fact("Motion calls", f"{stats.motion_calls:,}; {counted(stats.reused_actions, 'action')} known before")
    yield Fact("Inverse kinematics", counted(stats.ik_calls, "call"))
    yield Fact("Configurations tested", f"{stats.validity_checks:,}")
    yield Fact("Time", f"{seconds:.1f} s")
    yield from (Fact(f"Time, {phase}", f"{taken:.2f} s") for phase, taken in stats.seconds.items())
    if run.stop in ENDINGS:
        yield Fact("Ended", ENDINGS[run.stop])
    if run.error:
        yield Fact("Error", run.error)
    if run.time_limited:
        yield Fact("Time limit", "of a query was hit: another run may end differently")
