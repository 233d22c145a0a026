"""The small pieces of tabletops: surfaces, boxes of instance files, and what a model reads of a box."""

from __future__ import annotations

from math import cos, sin

import pytest
from hypothesis import given
from hypothesis import strategies as st

from llm3.types import GREY, ITSELF, Entity, Pose, color_of
from llm3_bullet.tabletop.box_spec import BoxShape, BoxSpec, upright
from llm3_bullet.tabletop.looks import look
from llm3_bullet.tabletop.rectangles import Rectangle
from llm3_bullet.tabletop.stance import shadow
from llm3_bullet.tabletop.table import Surface, support_height, table
from llm3_bullet.tabletop.wording import box_entity

LOW, HIGH = Surface(Rectangle((0.5, 0.0), (0.2, 0.2)), 0.01), Surface(Rectangle((0.6, 0.0), (0.2, 0.2)), 0.05)


@pytest.mark.parametrize(("x", "height"), [(0.3, 0.0), (0.42, 0.01), (0.55, 0.05), (0.75, 0.0)])
def test_a_box_stands_on_the_highest_surface_that_it_touches(x, height):
    assert support_height((LOW, HIGH), Rectangle((x, 0.0), (0.05, 0.05))) == height
    assert support_height((HIGH, LOW), Rectangle((x, 0.0), (0.05, 0.05))) == height


def test_the_tables_top_is_at_the_height_0():
    assert table().pose.position[2] + table().size[2] / 2 == 0.0
    assert table().fixed


@given(st.floats(0.2, 0.6), st.floats(-0.3, 0.3), st.floats(-3.14, 3.14), st.floats(0.0, 0.1))
def test_a_box_stands_at_its_start_on_what_is_below(x, y, yaw, height):
    spec = BoxSpec("a", (0.05, 0.06, 0.07), (x, y), yaw)
    box = spec.standing(height)
    assert box.pose == upright((x, y), height + 0.035, yaw)
    seen = shadow(box.pose, box.size)
    assert seen.contains((x, y))
    assert seen.overhang(spec.footprint) == pytest.approx(0.0, abs=2e-4)  # poses are on a grid of 0.1 mm


@given(st.floats(-0.2, 0.2), st.floats(-0.2, 0.2), st.floats(-3.14, 3.14))
def test_a_rectangle_contains_what_a_tiny_one_there_does_not_reach_out_of(x, y, angle):
    area = Rectangle((0.02, -0.03), (0.2, 0.1), (cos(angle), sin(angle)))
    assert area.contains((x, y)) == (area.overhang(Rectangle((x, y), (0.0, 0.0))) == 0.0)


class Shelf(BoxShape):
    taken = ("table", "shelf", ITSELF)
    kind = "jar"


@pytest.mark.parametrize(
    ("shape", "name", "size", "sentence"),
    [
        (BoxShape, "table", 0.1, "a box cannot be called 'table'; these names are taken: table, itself"),
        (Shelf, "shelf", 0.1, "a jar cannot be called 'shelf'; these names are taken: table, shelf, itself"),
        (Shelf, "a jar", 0.1, "a jar's name must be letters, digits and underscores, no digit first, not 'a jar'"),
        (Shelf, "jar", 0.0, "the sides of jar must be 0.005 to 0.5 m, not [0.0, 0.1, 0.1]"),
    ],
)
def test_a_shape_that_makes_no_sense_is_refused(shape, name, size, sentence):
    with pytest.raises(ValueError) as error:
        shape(name, (size, 0.1, 0.1))
    assert str(error.value) == sentence


def test_a_box_is_told_with_whatever_else_is_known_of_it():
    size = (0.05, 0.05, 0.07)
    assert box_entity("a", size, Pose((0.4, 0.1, 0.035)), **{"stands on": "table"}) == Entity(
        "a", {"position": (0.4, 0.1, 0.035), "size": size, "theta": 0.0, "stands on": "table"}
    )
    assert box_entity("a", size, None) == Entity("a", {"size": size, "position": "in the gripper"})


def test_a_colour_goes_by_the_first_word_of_a_name():
    assert look("red_block") == look("red_box") == color_of("red") != GREY
    assert look("puce_box") == GREY
    assert look("basket_wall_front") == look("basket") != GREY
