"""What a drawing marks is what the failure names."""

from __future__ import annotations

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
        assert not failure.contacts or failure.objects[0] in marked, f"attempt {turn.number} of {folder}"
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
    families = [
        ("boxpack", "hard-small", 14),
        ("boxpack", "hard-medium", 8),
        ("boxpack", "hard-large", 8),
        ("blocks", "blocks-4", 5),
        ("kitchen", "kitchen-4", 5),
        ("tabletop2d", "clutter", 10),
    ]
    runs = [
        record(tmp_path / f"{setting}-{seed}", RunConfig(domain, setting, seed, llm="random", timing="none"))
        for domain, setting, count in families
        for seed in range(count)
    ]
    assert len(runs) == 50
    assert sum(map(check, runs)) > 100
