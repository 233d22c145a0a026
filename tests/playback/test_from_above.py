"""A domain that can say what is seen from above needs no stage of its own."""

from __future__ import annotations

import numpy as np
import pytest

from llm3.errors import MissingCapability, PluginError
from llm3.playback import open_stage
from llm3.types import Pose, Shape, State, moment_of


def square(name, x, y, half=0.1, **more):
    return Shape(name, ((x - half, y - half), (x + half, y - half), (x + half, y + half), (x - half, y + half)), **more)


class Plane:
    """A room with a red box."""

    name = "plane"

    def stage(self, instance, options, window=False):
        return None

    def scenery(self, instance, options):
        return None

    def top_view(self, instance, options, state):
        x, y, _ = state.poses["red_box"].position
        return square("room", 0, 0, 1.0, fixed=True, color=(0.0, 0.0, 1.0)), square("red_box", x, y)


def at(x, y):
    return State({"red_box": Pose((x, y, 0.0))})


def drawn(state, domain=None):
    stage = open_stage(domain or Plane(), 7, {}, state, "llm3 render")
    stage.show(moment_of(state))
    return stage.picture(200, 100)


def test_things_are_where_they_are_and_have_their_colours():
    picture = drawn(at(0.8, 0.8)).astype(int)
    assert picture.shape == (100, 200, 3)
    red = (picture[:, :, 0] > 150) & (picture[:, :, 2] < 100)
    blue = (picture[:, :, 2] > 200) & (picture[:, :, 0] < 50)
    rows, columns = np.nonzero(red)
    assert rows.mean() < 20  # y points up
    assert columns.mean() > 130  # x points to the right
    assert blue.sum() == pytest.approx(92 * 92, rel=0.07)  # the room as large as fits


def test_the_same_state_gives_the_same_picture():
    assert np.array_equal(drawn(at(0.0, 0.3)), drawn(at(0.0, 0.3)))
    assert not np.array_equal(drawn(at(0.0, 0.3)), drawn(at(0.1, 0.3)))


def test_a_domain_that_shows_nothing_is_told():
    class Dark(Plane):
        name = "dark"

        def top_view(self, instance, options, state):
            return None

    with pytest.raises(MissingCapability) as error:
        drawn(at(0, 0), Dark())
    assert str(error.value) == "domain 'dark' has no stage, no top view and no scenery, which llm3 render needs."


def test_what_is_no_shape_is_the_domains_mistake():
    class Wrong(Plane):
        def top_view(self, instance, options, state):
            return ("room",)

    with pytest.raises(PluginError) as error:
        drawn(at(0, 0), Wrong())
    assert str(error.value) == "Wrong.top_view must answer a tuple of Shape, and 'room' is none."
