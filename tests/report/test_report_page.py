"""The report of a run can be read by everybody, says what the record says, and holds nothing that it fetches."""

from __future__ import annotations

import re
from itertools import pairwise

import pytest
from reported import read_page, record

from llm3.assembly import RunConfig
from llm3.records import read_run
from llm3.registry import Registry
from llm3.report import read_story, run_report
from llm3.wording import failure_in_words

CLUTTER = RunConfig("tabletop2d", "clutter", seed=1, timing="none", max_llm_calls=5)
HOSTILE = """</pre><script>alert("x")</script><img src="http://example.org/x.png">&lt;b&gt;'"""
REASONED = HOSTILE.replace('"', "'")
REPLIES = [
    f"""{{"Reasoning": "{REASONED}", "Full Plan": ["pick(['red_disc'], {{'angle': 0.0}})"]}}""",
    f"no plan at all {HOSTILE}",
    '{"Reasoning": "", "Full Plan": []}',
]


@pytest.fixture(scope="module")
def solved(tmp_path_factory):
    return record(tmp_path_factory.mktemp("solved"), CLUTTER)


@pytest.fixture(scope="module")
def hostile(tmp_path_factory):
    return record(tmp_path_factory.mktemp("hostile"), RunConfig("tabletop2d", "clutter", max_llm_calls=3), REPLIES)


@pytest.fixture(scope="module")
def search(tmp_path_factory):
    config = RunConfig("tabletop2d", "clutter", solver="search", timing="none", max_motion_calls=100)
    return record(tmp_path_factory.mktemp("search"), config)


@pytest.fixture(scope="module", params=["solved", "hostile", "search"])
def folder(request):
    return request.getfixturevalue(request.param)


@pytest.fixture(scope="module")
def page(folder):
    return told(folder)


@pytest.fixture(scope="module")
def solved_page(solved):
    return told(solved)


def told(folder):
    return read_page(run_report(Registry.discover(), folder, moving=False).page)


def test_it_has_a_language_a_title_and_headings_that_skip_no_level(page):
    (html,) = page.all("html")
    assert html.attributes["lang"] == "en"
    assert next(title.text for title in page.all("title"))
    levels = [int(heading.tag[1]) for heading in page.all("h1", "h2", "h3", "h4")]
    assert levels[0] == 1
    assert levels.count(1) == 1
    assert all(after <= before + 1 for before, after in pairwise(levels))


def test_every_picture_says_what_it_shows(page):
    assert all(image.attributes["alt"] for image in page.all("img"))
    assert all(svg.attributes["role"] == "img" and svg.attributes["aria-label"] for svg in page.all("svg"))
    assert all(frame.attributes["title"] for frame in page.all("iframe"))


def test_every_table_has_a_caption_or_heads_of_its_columns(page):
    for table in page.all("table"):
        assert list(table.all("caption")) or list(table.all("thead"))
        assert all(head.attributes["scope"] in ("row", "col", "colgroup") for head in table.all("th"))


def test_what_can_be_pressed_has_a_name_and_what_is_linked_is_there(page):
    assert all(element.text for element in page.all("button", "a", "summary"))
    names = [element.attributes["id"] for element in page.all() if "id" in element.attributes]
    assert len(set(names)) == len(names)
    targets = [link.attributes["href"] for link in page.all("a")]
    assert all(target.startswith("#") and target[1:] in names for target in targets)
    labels = [
        element.attributes["aria-labelledby"] for element in page.all() if "aria-labelledby" in element.attributes
    ]
    assert set(labels) <= set(names)


def test_nothing_is_fetched(solved):
    page = read_page(run_report(Registry.discover(), solved).page)
    assert len(list(page.all("iframe"))) == 1
    for element in page.all():
        for name in ("src", "href", "action", "data", "poster"):
            assert re.match(r"(data:|#|$)", element.attributes.get(name, "")), element
    (policy,) = (meta for meta in page.all("meta") if "http-equiv" in meta.attributes)
    assert policy.attributes["content"].startswith("default-src 'none'; ")
    assert "http" not in policy.attributes["content"]


def test_what_a_model_wrote_stays_text(hostile):
    page = told(hostile)
    assert list(page.all("script", "img")) == []
    replies = [element.text for element in page.all("pre") if "no plan at all" in element.text]
    assert " ".join(f"no plan at all {HOSTILE}".split()) in replies


def test_the_last_attempts_are_told_with_every_action_and_how_it_ended(folder, page):
    story = read_story(folder)
    told = story.turns[-50:]
    articles = list(page.all("article"))
    assert len(articles) == len(told)
    for turn, article in zip(told, articles, strict=True):
        (heading,) = article.all("h3")
        assert heading.text.startswith(f"Attempt {turn.number}: ")
        rows = [row.text for body in article.all("tbody") for row in body.all("tr")]
        actions = [tried.outcome.action for tried in turn.tried] + list(turn.untried)
        assert len(rows) == len(actions)
        assert all(str(action) in row for action, row in zip(actions, rows, strict=True))
        if turn.failed:
            assert failure_in_words(turn.failed.outcome.failure) in rows[turn.failed.index]
            assert "failed" in rows[turn.failed.index]


def test_the_whole_conversation_can_be_unfolded(solved, solved_page):
    written = [element.text for element in solved_page.all("pre")]
    for turn in read_story(solved).turns:
        for text in (*(message.content for message in turn.messages), turn.completion.text):
            assert " ".join(text.split()) in written


def test_every_prompt_but_the_first_says_what_changed_in_it(solved_page):
    first, *later = solved_page.all("article")
    assert later, "a run of one attempt shows nothing here"
    assert list(first.all("ins", "del")) == []
    for article in later:
        assert list(article.all("ins"))


def test_the_figures_are_the_records(folder, page):
    run = read_run(folder)
    facts = {row.children[0].text: row.children[1].text for table in page.classed("facts") for row in table.all("tr")}
    assert facts["Model calls"] == f"{run.stats.llm_calls:,}"
    assert facts["Motion calls"].startswith(f"{run.stats.motion_calls:,}; ")
    assert facts["Configurations tested"] == f"{run.stats.validity_checks:,}"
    (verdict,) = page.classed("verdict")
    assert verdict.text == run.status


def test_a_plan_is_drawn_step_by_step_where_there_are_no_pictures(solved, solved_page):
    story = read_story(solved)
    (steps,) = solved_page.classed("steps")
    start, *items = steps.all("li")
    assert next(start.all("p")).text == "The start"
    assert [next(item.all("code")).text for item in items] == [str(step.action) for step in story.result.plan]
    assert all(len(list(item.all("svg"))) == 1 for item in (start, *items))


def test_of_very_many_attempts_the_last_are_told(search):
    story = read_story(search)
    page = told(search)
    assert len(story.turns) > 50, "a search of fewer attempts shows nothing here"
    assert f"The first {len(story.turns) - 50} are left out; the run's record has them all." in page.text


def test_the_same_record_gives_the_same_page(solved):
    registry = Registry.discover()
    assert run_report(registry, solved, moving=False) == run_report(registry, solved, moving=False)
