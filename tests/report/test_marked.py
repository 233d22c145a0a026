"""What a drawing marks is what the failure names."""

from __future__ import annotations

from dataclasses import replace

import pytest
from reported import read_page, record

from llm3.assembly import RunConfig
from llm3.registry import Registry
from llm3.report import read_story, run_report

DRAWN = RunConfig("tabletop2d", "clutter", llm="random", timing="none", max_llm_calls=15)
PACKED = RunConfig("boxpack", "hard-small", llm="random", timing="none", max_llm_calls=15)


def named(turn):
    """What touches at the failure of a turn, by the words of the record alone."""
    found = set()
    for contact in turn.failed.outcome.failure.contacts:
        found |= {contact.link or contact.part.removeprefix("held ").removeprefix("pushed "), contact.object}
    return found


def check(folder):
    """See that every failed attempt has a drawing that marks the right things; tells how many have a contact."""
    page = read_page(run_report(Registry.discover(), folder, moving=False).page)
    failed = [turn for turn in read_story(folder).turns if turn.failed]
    articles = {next(article.all("h3")).attributes["id"]: article for article in page.all("article")}
    touching = 0
    for turn in failed:
        (drawing,) = articles[f"attempt-{turn.number}"].all("svg")
        marked = {polygon.attributes["data-name"] for polygon in drawing.classed("touching")}
        failure = turn.failed.outcome.failure
        assert marked == named(turn), f"attempt {turn.number} of {folder}"
        assert not failure.contacts or set(failure.objects[:1]) <= marked, f"attempt {turn.number} of {folder}"
        touching += bool(failure.contacts)
    return touching


def test_what_touches_is_marked_in_the_plane(tmp_path):
    assert check(record(tmp_path / "run", DRAWN)) > 3


@pytest.mark.pybullet
def test_what_touches_is_marked_around_an_arm(tmp_path):
    assert check(record(tmp_path / "run", PACKED)) > 3


@pytest.mark.slow
@pytest.mark.pybullet
def test_what_touches_is_marked_in_every_failed_attempt_of_fifty_runs(tmp_path):
    families = [  # a planner that hardly searches fails between free ends, too
        (RunConfig("boxpack", "hard-small", llm="random"), 10),
        (RunConfig("boxpack", "hard-medium", llm="random"), 6),
        (RunConfig("boxpack", "hard-large", llm="random"), 6),
        (RunConfig("boxpack", "hard-small", llm="random", planner_iterations=1, options={"walls": "0.2"}), 6),
        (RunConfig("blocks", "blocks-5"), 6),
        (RunConfig("kitchen", "kitchen-4"), 6),
        (RunConfig("tabletop2d", "clutter", llm="random"), 10),
    ]
    runs = [
        record(tmp_path / f"{number}-{seed}", replace(config, seed=seed, timing="none"))
        for number, (config, count) in enumerate(families)
        for seed in range(count)
    ]
    assert len(runs) == 50
    assert sum(map(check, runs)) > 100
