"""A replay is one page, with its chapters in it as data."""

from __future__ import annotations

import json
import re

import numpy as np
import pytest

from llm3.errors import MissingDependency
from llm3.interfaces import Scenery
from llm3.playback import Chapter, replay_page
from llm3.types import Body, Moment, box_surface


class Slider(Scenery):
    """A box that slides along x with the robot's one joint."""

    bodies = (Body("box", (box_surface((0.1, 0.1, 0.1)),)),)

    def places(self, moment):
        frame = np.eye(4)
        frame[0, 3] = moment.configuration[0]
        return {"box": frame}


def moments(*times):
    return [Moment((time,), time=time) for time in times]


def chapters_of(page):
    (found,) = re.findall(r"const CHAPTERS = (.*?);\n", page)
    return json.loads(found)


def test_chapters_follow_one_another_each_from_its_own_first_moment():
    page = replay_page("Slides", Slider(), [Chapter("one", moments(5.0, 7.0)), Chapter("two", moments(1.0, 1.5))])
    one, two = chapters_of(page)
    assert (one["title"], two["title"]) == ("one", "two")
    assert one["time"] < 0.5
    assert 2.0 < two["time"] < 3.0


def test_time_that_runs_backwards_stands_still():
    (chapter,) = chapters_of(replay_page("Slides", Slider(), [Chapter("one", moments(1.0, 0.0, 2.0))]))
    assert chapter["time"] < 0.5


def test_a_title_is_text_wherever_it_stands():
    rude = "</script><script>alert(1)</script><!--"
    page = replay_page(rude, Slider(), [Chapter(rude, moments(0.0))])
    assert rude not in page
    assert "<title>&lt;/script&gt;" in page
    assert chapters_of(page)[0]["title"] == rude


def test_without_viser_there_is_none(monkeypatch):
    monkeypatch.setattr("llm3.playback.replay.find_spec", lambda name: None)
    with pytest.raises(MissingDependency) as raised:
        replay_page("Slides", Slider(), [])
    assert str(raised.value) == "a replay needs viser, which is not installed: pip install 'llm3[viz]'."
