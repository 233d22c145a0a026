from __future__ import annotations

from dataclasses import replace
from math import cos, dist, pi, sin

import numpy as np
import pytest
from hypothesis import assume, given
from hypothesis import strategies as st

from llm3_bullet.tabletop.rectangles import Rectangle

coordinates = st.floats(-0.3, 0.3)
sides = st.floats(0.01, 0.3)
angles = st.floats(-pi, pi)


def rectangle(x: float, y: float, dx: float, dy: float, angle: float) -> Rectangle:
    return Rectangle((x, y), (dx, dy), (cos(angle), sin(angle)))


rectangles = st.builds(rectangle, coordinates, coordinates, sides, sides, angles)


def transformed(r: Rectangle, angle: float, dx: float, dy: float) -> Rectangle:
    rotation = np.array([[cos(angle), -sin(angle)], [sin(angle), cos(angle)]])
    x, y = rotation @ r.center + (dx, dy)
    u, v = rotation @ r.direction
    return replace(r, center=(float(x), float(y)), direction=(float(u), float(v)))


def scaled(r: Rectangle, factor: float) -> Rectangle:
    return replace(r, size=(r.size[0] * factor, r.size[1] * factor))


def clear_cut(a: Rectangle, b: Rectangle) -> bool:
    """Whether overlap does not hang on rounding."""
    return scaled(a, 0.999).overlaps(b) == scaled(a, 1.001).overlaps(b)


@given(rectangles, rectangles)
def test_overlap_is_symmetric(a, b):
    assert a.overlaps(b) == b.overlaps(a)


@given(rectangles, coordinates, coordinates)
def test_no_corner_is_nearer_than_the_nearest_point_which_is_in_it(a, x, y):
    found = a.nearest((x, y))
    assert scaled(a, 1 + 1e-9).contains(found)
    assert dist(found, (x, y)) <= np.hypot(*(a.corners - (x, y)).T).min() + 1e-12
    assert a.nearest(found) == pytest.approx(found, abs=1e-12)
    if a.contains((x, y)):
        assert found == pytest.approx((x, y), abs=1e-12)


@given(rectangles)
def test_a_rectangle_overlaps_itself_and_does_not_reach_out_of_itself(a):
    assert a.overlaps(a)
    assert a.overhang(a) == pytest.approx(0.0, abs=1e-12)


@given(rectangles, rectangles, angles, coordinates, coordinates)
def test_a_rigid_motion_of_both_changes_nothing(a, b, angle, dx, dy):
    assume(clear_cut(a, b))
    c, d = transformed(a, angle, dx, dy), transformed(b, angle, dx, dy)
    assert c.overlaps(d) == a.overlaps(b)
    assert c.overhang(d) == pytest.approx(a.overhang(b), abs=1e-9)


@given(rectangles, rectangles)
def test_the_direction_may_point_either_way_and_the_sides_may_be_swapped(a, b):
    assume(clear_cut(a, b))
    (u, v), (dx, dy) = b.direction, b.size
    for same in (replace(b, direction=(-u, -v)), replace(b, direction=(-v, u), size=(dy, dx))):
        assert a.overlaps(same) == a.overlaps(b)
        assert a.overhang(same) == pytest.approx(a.overhang(b), abs=1e-12)


@given(rectangles, rectangles, st.lists(st.tuples(st.floats(-0.5, 0.5), st.floats(-0.5, 0.5)), max_size=20))
def test_rectangles_with_a_common_point_overlap(a, b, points):
    def inside(r: Rectangle, point: np.ndarray) -> bool:
        u, v = np.array(r.direction), np.array((-r.direction[1], r.direction[0]))
        offset = point - r.center
        return abs(offset @ u) < 0.999 * r.size[0] / 2 and abs(offset @ v) < 0.999 * r.size[1] / 2

    u, v = np.array(a.direction), np.array((-a.direction[1], a.direction[0]))
    for s, t in points:
        point = a.center + 0.99 * s * a.size[0] * u + 0.99 * t * a.size[1] * v
        assert not inside(b, point) or a.overlaps(b)


@given(rectangles, rectangles, angles)
def test_rectangles_on_two_sides_of_a_line_do_not_overlap(a, b, angle):
    axis = np.array((cos(angle), sin(angle)))
    gap = (b.corners @ axis).min() - (a.corners @ axis).max()
    assume(abs(gap) > 1e-9)
    assert gap < 0 or not a.overlaps(b)


@given(rectangles, rectangles)
def test_overhang_is_zero_exactly_where_all_corners_are_inside(outer, inner):
    u, v = np.array(outer.direction), np.array((-outer.direction[1], outer.direction[0]))
    local = np.abs((inner.corners - outer.center) @ np.column_stack([u, v])) - np.array(outer.size) / 2
    assume(abs(local.max()) > 1e-9)
    assert (outer.overhang(inner) == 0.0) == bool((local < 0).all())
    assert outer.overhang(inner) == pytest.approx(max(0.0, local.max()), abs=1e-12)


@given(rectangles)
def test_the_corners_run_counter_clockwise_around_the_centre(r):
    corners = r.corners
    assert corners.mean(axis=0) == pytest.approx(np.array(r.center), abs=1e-12)
    x, y = corners.T
    area = 0.5 * float(np.sum(x * np.roll(y, -1) - np.roll(x, -1) * y))
    assert area == pytest.approx(r.size[0] * r.size[1])


def test_rectangles_that_share_an_edge_do_not_overlap():
    assert not Rectangle((0.0, 0.0), (2.0, 2.0)).overlaps(Rectangle((2.0, 0.0), (2.0, 2.0)))


def test_overhang_is_how_far_the_farthest_corner_reaches_out():
    outer = Rectangle((0.0, 0.0), (2.0, 2.0))
    assert outer.overhang(Rectangle((1.0, 0.0), (0.5, 0.5))) == pytest.approx(0.25)
    diamond = Rectangle((1.0, 0.0), (0.5, 0.5), (cos(pi / 4), sin(pi / 4)))
    assert outer.overhang(diamond) == pytest.approx(0.25 * 2**0.5)


@given(sides, sides, sides, sides)
def test_there_is_room_for_what_fits_at_some_angle(a, b, p, q):
    area = Rectangle((0.2, 0.1), (a, b))
    turns = np.linspace(0.0, pi / 2, 2001)
    wide, high = p * np.cos(turns) + q * np.sin(turns), p * np.sin(turns) + q * np.cos(turns)
    if ((wide <= a) & (high <= b)).any():
        assert area.has_room_for((p, q), tolerance=1e-12)
    if ((wide > a + 1e-4) | (high > b + 1e-4)).all():
        assert not area.has_room_for((p, q))


@pytest.mark.parametrize(
    ("size", "fits"),
    [((0.2, 0.1), True), ((0.1, 0.2), True), ((0.21, 0.1), False), ((0.21, 0.01), True), ((0.05, 0.11), True)],
)
def test_room_is_found_across_and_slantwise(size, fits):
    assert Rectangle((0.0, 0.0), (0.2, 0.1)).has_room_for(size) is fits


def test_what_reaches_out_a_little_may_be_let_in():
    assert Rectangle((0.0, 0.0), (0.2, 0.1)).has_room_for((0.201, 0.1015), tolerance=0.001)


def test_the_area_is_the_product_of_the_sides():
    assert Rectangle((0.3, 0.0), (0.2, 0.1), (0.6, 0.8)).area == pytest.approx(0.02)
