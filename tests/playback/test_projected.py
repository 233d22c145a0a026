"""What is seen from above of bodies are their shadows at noon."""

from __future__ import annotations

from math import cos, pi, sin

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from llm3.interfaces import Scenery
from llm3.playback.projected import projection
from llm3.types import Body, Moment, Surface, box_surface

lengths = st.floats(0.05, 2)
angles = st.floats(-pi, pi)


class Bodies(Scenery):
    def __init__(self, *placed):
        self.bodies = tuple(body for body, _ in placed)
        self.frames = {body.name: frame for body, frame in placed if frame is not None}

    bodies = ()

    def places(self, moment):
        return self.frames


def turned(angle, x=0.0, y=0.0, z=0.0):
    frame = np.eye(4)
    frame[:2, :2] = (cos(angle), -sin(angle)), (sin(angle), cos(angle))
    frame[:3, 3] = x, y, z
    return frame


def area(shape):
    x, y = np.array(shape.corners).T
    return (x @ np.roll(y, -1) - y @ np.roll(x, -1)) / 2


@given(lengths, lengths, lengths, angles, st.floats(-1, 1), st.floats(-1, 1))
def test_a_box_that_stands_has_the_shadow_of_its_base(length, width, height, angle, x, y):
    box = Body("box", (box_surface((length, width, height)),))
    (shape,) = projection(Bodies((box, turned(angle, x, y))))(Moment())
    assert area(shape) == pytest.approx(length * width)  # counter-clockwise, too
    assert np.array(shape.corners).mean(axis=0) == pytest.approx((x, y), abs=1e-9)


@given(st.lists(st.tuples(*[st.floats(-1, 1)] * 3), min_size=4, max_size=30))
def test_no_corner_stands_out_of_the_shadow(points):
    surface = Surface(np.array(points), np.array([(0, 1, 2)]))
    (shape,) = projection(Bodies((Body("thing", (surface,)), np.eye(4))))(Moment())
    corners = np.array(shape.corners)
    ahead = np.roll(corners, -1, axis=0) - corners
    for x, y, _ in points:
        out = ahead[:, 0] * (y - corners[:, 1]) - ahead[:, 1] * (x - corners[:, 0])
        assert (out >= -1e-6).all()


def test_what_is_higher_lies_on_top_and_the_robot_above_all():
    box = box_surface((0.1, 0.1, 0.1))
    low, high, robot = Body("low", (box,)), Body("high", (box,), "fixed"), Body("robot", (box,), "robot")
    view = projection(Bodies((high, turned(0, z=1)), (robot, turned(0)), (low, turned(0, z=0.5))))
    shapes = view(Moment())
    assert [shape.name for shape in shapes] == ["low", "high", "robot"]
    assert [(shape.fixed, shape.robot) for shape in shapes] == [(False, False), (True, False), (False, True)]


def test_what_is_not_there_has_no_shadow():
    box = Body("box", (box_surface((0.1, 0.1, 0.1)),))
    assert projection(Bodies((box, None)))(Moment()) == ()


def test_two_pieces_of_a_wall_leave_the_gap_between_them_open():
    box = box_surface((0.1, 0.4, 0.1))
    pieces = tuple(Surface(box.corners + np.array((0, y, 0)), box.triangles) for y in (-0.5, 0.5))
    shapes = projection(Bodies((Body("wall", pieces, "fixed"), np.eye(4))))(Moment())
    assert [shape.name for shape in shapes] == ["wall", "wall"]
    assert sum(map(area, shapes)) == pytest.approx(2 * 0.1 * 0.4)
