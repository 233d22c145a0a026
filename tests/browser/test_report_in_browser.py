"""A report opens from disk without a network, plays, marks what touches, and can be used without a mouse."""

from __future__ import annotations

from io import BytesIO

import numpy as np
import pytest
from axe_playwright_python.sync_playwright import Axe
from PIL import Image

from llm3.cli.main import main

pytestmark = [pytest.mark.slow, pytest.mark.pybullet]
MEGABYTES_OF_A_REPORT = 8
PATIENCE = 60_000
"""Milliseconds to wait for what a page does, on whatever machine."""
AXE = {"iframes": False}
"""A frame is looked at by itself: nothing can be asked across its wall."""


@pytest.fixture
def replay(page):
    """The replay in the report, at the beginning of the plan, at a standstill."""
    page.locator("#player").scroll_into_view_if_needed()  # a frame that nobody sees has to wait
    frame = ready(page.frame_locator("#player"))
    frame.get_by_label("Chapter").select_option(label="The plan")
    return frame


def ready(frame):
    """The same page or frame, once its replay can be played."""
    frame.locator("html[data-ready]").wait_for(timeout=PATIENCE, state="attached")
    return frame


def picture(frame):
    """What the replay shows at a standstill, as pixels: it draws when it comes to it, so some looks may be needed."""
    last = look(frame)
    for _ in range(20):
        seen = look(frame)
        if changed(last, seen) == 0:
            return seen
        last = seen
    raise AssertionError("it does not stand still")


def look(frame):
    canvas = frame.locator("canvas[data-engine]")
    canvas.page.wait_for_timeout(1000)
    return np.asarray(Image.open(BytesIO(canvas.screenshot(timeout=PATIENCE))).convert("RGB")).astype(int)


def changed(before, after):
    """How many pixels are not what they were."""
    return int((np.abs(before - after).max(axis=2) > 30).sum())


def pink(pixels):
    """How many pixels have the colour of what touches."""
    red, green, blue = np.moveaxis(pixels, 2, 0)
    return int(((red > 180) & (blue > 130) & (green < 110)).sum())


def hindrances(page):
    """What keeps people from using a page or a frame, such as too little contrast, one in each line."""
    return Axe().run(page, options=AXE).generate_snapshot()


def time(frame):
    return float(frame.get_by_label("Time in seconds").input_value())


@pytest.fixture(scope="module")
def small(reported):
    """The same report without pictures and replay."""
    file = reported.with_name("small.html")
    assert main(["report", str(reported.parent), "--small", "--quiet", "--out", str(file)]) == 0
    return file


def test_it_is_one_file_of_a_few_megabytes(reported):
    assert reported.stat().st_size < MEGABYTES_OF_A_REPORT * 10**6


def test_the_play_button_moves_the_arm_and_the_pause_button_stops_it(page, replay):
    before, began = picture(replay), time(replay)
    replay.get_by_role("button", name="Play").press("Enter")  # a slow machine may not know yet where a mouse would be
    page.wait_for_timeout(3000)
    replay.get_by_role("button", name="Pause").press("Enter")
    after = picture(replay)
    assert time(replay) > began + 1
    assert changed(before, after) > 300


def test_an_attempt_that_failed_is_shown_with_what_touches_in_pink(page, replay):
    assert pink(picture(replay)) < 10  # where red meets blue
    page.get_by_role("button", name="Show attempt 1 in three dimensions").press("Enter")
    assert pink(picture(replay)) > 30
    assert "touches" in replay.get_by_role("status").inner_text()
    replay.get_by_label("Chapter").select_option(label="The plan")
    assert pink(picture(replay)) < 10  # where red meets blue


def test_an_attempt_that_is_asked_for_before_the_replay_is_seen_is_shown_when_it_is(reported, visit):
    with visit(reported) as page:
        page.get_by_role("button", name="Show attempt 1 in three dimensions").press("Enter")
        assert pink(picture(ready(page.frame_locator("#player")))) > 30


def test_the_replay_can_be_played_and_sought_by_keyboard(page, replay):
    replay.get_by_role("button", name="Play").focus()
    page.keyboard.press("Enter")
    replay.get_by_role("button", name="Pause").wait_for(timeout=PATIENCE)
    page.keyboard.press("Enter")
    replay.get_by_role("button", name="Play").wait_for(timeout=PATIENCE)
    replay.get_by_label("Chapter").focus()
    page.keyboard.press("ArrowDown")
    page.wait_for_timeout(500)
    assert time(replay) > 10


def test_playing_stops_at_the_end_of_a_chapter_and_begins_it_again(page, replay):
    attempt = replay.get_by_label("Chapter").locator("option").last.inner_text()
    replay.get_by_label("Chapter").select_option(label=attempt)
    page.wait_for_timeout(500)
    began = time(replay)
    for _ in range(2):
        replay.get_by_role("button", name="Play").press("Enter")
        page.wait_for_timeout(6000)
        assert replay.get_by_role("button", name="Play").is_visible()
        assert began + 1.5 < time(replay) < began + 2.5


def test_everything_that_can_be_used_is_reached_by_tab_and_shows_that_it_is(small, visit):
    with visit(small) as page:
        wanted = page.locator("main a, main summary, main button").count()
        reached = set()
        for _ in range(wanted + 20):
            page.keyboard.press("Tab")
            found = page.evaluate(
                """() => {
                    const all = [...document.querySelectorAll("main a, main summary, main button")];
                    const outline = getComputedStyle(document.activeElement).outlineStyle;
                    return { index: all.indexOf(document.activeElement), outline };
                }"""
            )
            if found["index"] >= 0:
                assert found["outline"] != "none"
                reached.add(found["index"])
        assert len(reached) == wanted


@pytest.mark.parametrize("width", [1200, 400])
def test_nothing_keeps_anybody_from_using_it_and_nothing_is_wider_than_the_page(small, visit, width):
    with visit(small, width) as page:
        page.evaluate("document.querySelectorAll('details').forEach((e) => { e.open = true; })")
        assert hindrances(page) == ""
        assert page.evaluate("document.documentElement.scrollWidth") <= width


def test_nothing_keeps_anybody_from_using_the_replay(page, replay):
    (frame,) = page.frames[1:]
    assert hindrances(frame) == ""


def test_a_replay_of_its_own_plays_too(reported, tmp_path, visit):
    file = tmp_path / "replay.html"
    assert main(["render", str(reported.parent), "--out", str(file), "--quiet"]) == 0
    with visit(file) as page:
        before = picture(ready(page))
        page.get_by_role("button", name="Play").press("Enter")
        page.wait_for_timeout(3000)
        page.get_by_role("button", name="Pause").press("Enter")
        assert changed(before, picture(page)) > 300


def test_the_report_of_an_experiment_leads_to_those_of_its_runs(tmp_path, visit):
    folder = tmp_path / "experiment"
    asked = [
        "experiment",
        "tabletop2d",
        "--attempts",
        "1",
        "--problem",
        "clutter",
        "--method",
        "offline",
        "--quiet",
        "--out",
    ]
    assert main([*asked, str(folder)]) == 0
    assert main(["report", str(folder), "--quiet"]) == 0
    with visit(folder / "report.html") as page:
        assert hindrances(page) == ""
        links = page.locator("#runs ~ * a")
        assert links.count() == 1
        target = (folder / links.first.get_attribute("href")).resolve()
    with visit(target) as page:
        assert "tabletop2d" in page.title()
