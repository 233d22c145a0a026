"""Distances are those of a plain, slow oracle, whatever the shapes; and nothing that is blocked is found free."""

from __future__ import annotations

from itertools import pairwise
from math import cos, hypot, sin

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from llm3_tabletop2d.bodies import Body, Separation
from llm3_tabletop2d.contact import beside

HERE = np.zeros((1, 2))
lengths = st.floats(0.0, 0.3)
places = st.tuples(st.floats(-0.5, 0.5), st.floats(-0.5, 0.5))
angles = st.floats(-3.2, 3.2)
discs = st.builds(lambda at, r: Body("disc", at, radius=r), places, lengths)
boxes = st.builds(lambda at, a, b, t: Body("box", at, (a, b), t), places, lengths, lengths, angles)
bodies = st.one_of(discs, boxes)


def outline(body: Body, count: int = 60) -> np.ndarray:
    """Points of the edge of a body, corners included."""
    if body.radius:
        t = np.linspace(0, 2 * np.pi, 4 * count)
        return np.array(body.center) + body.radius * np.stack([np.cos(t), np.sin(t)], axis=1)
    a, b = body.sides[0] / 2, body.sides[1] / 2
    corners = [(-a, -b), (a, -b), (a, b), (-a, b), (-a, -b)]
    points = np.concatenate([np.linspace(p, q, count) for p, q in pairwise(corners)])
    c, s = cos(body.angle), sin(body.angle)
    return points @ np.array([(c, s), (-s, c)]) + body.center


def contains(body: Body, point: np.ndarray) -> bool:
    dx, dy = point - body.center
    if body.radius:
        return hypot(dx, dy) < body.radius
    c, s = cos(body.angle), sin(body.angle)
    return abs(c * dx + s * dy) < body.sides[0] / 2 and abs(c * dy - s * dx) < body.sides[1] / 2


def gap(a: Body, b: Body) -> float:
    return float(Separation((a,), (b,)).gaps(HERE)[0, 0])


@settings(max_examples=60)
@given(bodies, bodies)
def test_the_distance_is_that_of_the_nearest_points(a, b):
    measured = gap(a, b)
    ours, theirs = outline(a), outline(b)
    nearest = float(np.linalg.norm(ours[:, None] - theirs, axis=2).min())
    overlap = any(contains(b, p) for p in ours) or any(contains(a, p) for p in theirs)
    # Points of an outline are up to 10 mm apart, and those of an overlap may lie between.
    if overlap:
        assert measured < 1e-9
    if measured > 0:
        assert measured - 1e-9 <= nearest <= measured + 0.011


@settings(max_examples=60)
@given(bodies, bodies)
def test_a_depth_is_the_shortest_way_out(a, b):
    depth = -gap(a, b)
    if depth <= 1e-6:
        return
    ways = [depth * np.array((cos(t), sin(t))) for t in np.linspace(0, 2 * np.pi, 720)]
    freed = Separation((a,), (b,)).gaps(np.array(ways))
    assert freed.max() > -0.02 * depth - 1e-9
    assert Separation((a,), (b,)).gaps(0.98 * np.array(ways)).max() < 1e-9


@given(bodies, bodies)
def test_two_bodies_are_as_far_from_one_another_either_way(a, b):
    assert gap(a, b) == pytest.approx(gap(b, a), abs=1e-9)


@settings(max_examples=30)
@given(
    st.lists(bodies, min_size=1, max_size=4),
    st.lists(bodies, min_size=1, max_size=4),
    st.lists(places, min_size=1, max_size=5),
)
def test_many_are_measured_as_one_by_one(moving, standing, points):
    separation = Separation(moving, standing)
    together = separation.gaps(np.array(points))
    assert together.shape == (len(points), len(moving) * len(standing))
    for row, point in zip(together, points, strict=True):
        for value, (a, b) in zip(row, separation.pairs, strict=True):
            alone = Separation((a,), (b,)).gaps(np.array([point]))[0, 0]
            assert value == pytest.approx(alone, abs=1e-12)


@given(bodies, bodies, places, st.floats(0.0, 0.1))
def test_a_horizon_changes_nothing_that_is_nearer(a, b, point, horizon):
    separation = Separation((a,), (b,))
    true = separation.gaps(np.array([point]))[0, 0]
    told = separation.gaps(np.array([point]), horizon)[0, 0]
    assert told == pytest.approx(true, abs=1e-12) if true < horizon else horizon - 1e-9 <= told <= true + 1e-9


@given(bodies, bodies, places, places)
def test_no_distance_changes_by_more_than_the_way_that_is_moved(a, b, p, q):
    one, two = Separation((a,), (b,)).gaps(np.array([p, q]))[:, 0]
    assert abs(one - two) <= hypot(p[0] - q[0], p[1] - q[1]) + 1e-9


@given(bodies, bodies, places, places, st.floats(0.0, 1.0))
def test_what_is_in_the_way_is_so_in_a_convex_area(a, b, p, q, share):
    """So a cell of a grid is blocked where its corners are."""
    between = tuple(share * u + (1 - share) * v for u, v in zip(p, q, strict=True))
    one, two, three = Separation((a,), (b,)).gaps(np.array([p, q, between]))[:, 0]
    assert three <= max(one, two) + 1e-9


@given(bodies, angles, st.floats(0.001, 0.1))
def test_beside_is_at_the_distance_and_in_the_direction_that_are_asked_for(body, angle, distance):
    offset = beside(body, angle, distance)
    point = Body("point", (body.center[0] + offset[0], body.center[1] + offset[1]))
    assert gap(point, body) == pytest.approx(distance, abs=1e-9)
    assert abs(np.angle(np.exp(1j * (np.arctan2(offset[1], offset[0]) - angle)))) < 1e-6
