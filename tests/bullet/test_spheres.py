from __future__ import annotations

import numpy as np
from hypothesis import given, settings
from hypothesis import strategies as st

from llm3_bullet.spheres import cover, cover_box, enclosing_sphere


@settings(max_examples=50, deadline=None)
@given(seed=st.integers(0, 2**32), count=st.integers(5, 60), slab=st.floats(0.02, 1.0))
def test_every_point_of_the_hull_is_in_a_sphere(seed, count, slab):
    rng = np.random.default_rng(seed)
    points = rng.normal(size=(count, 3)) * rng.uniform(0.02, 0.3, 3)
    centres, radii = cover(points, slab)
    inside = rng.dirichlet(np.full(count, 0.1), 500) @ points
    distances = np.linalg.norm(inside[:, None] - centres, axis=2)
    assert (distances <= radii + 1e-9).any(axis=1).all()


@settings(max_examples=50, deadline=None)
@given(seed=st.integers(0, 2**32), count=st.integers(1, 60))
def test_an_enclosing_sphere_encloses_and_is_small(seed, count):
    points = np.random.default_rng(seed).normal(size=(count, 3))
    centre, radius = enclosing_sphere(points)
    assert np.linalg.norm(points - centre, axis=1).max() <= radius + 1e-12
    diameter = np.linalg.norm(points[:, None] - points, axis=2).max()
    assert radius <= 1.05 * diameter * np.sqrt(3 / 8) + 1e-12  # Jung's theorem, and a little


def test_thinner_slabs_give_smaller_spheres():
    corners = np.array([[x, y, z] for x in (0, 0.02) for y in (0, 0.02) for z in (0, 0.4)])
    assert len(cover(corners, 1.0)[1]) == 1
    centres, radii = cover(corners, 0.05)
    assert len(radii) == 8
    np.testing.assert_allclose(radii, np.sqrt(0.01**2 + 0.01**2 + 0.025**2), rtol=0.05)
    np.testing.assert_allclose(sorted(centres[:, 2]), np.arange(0.025, 0.4, 0.05), atol=0.003)


@settings(max_examples=50, deadline=None)
@given(seed=st.integers(0, 2**32), sides=st.tuples(*[st.floats(0.005, 0.5)] * 3))
def test_every_point_of_a_box_is_in_a_sphere(seed, sides):
    centres, radius = cover_box(sides)
    assert len(centres) <= 27
    points = (np.random.default_rng(seed).uniform(-0.5, 0.5, (500, 3)).round(1)) * sides  # faces and edges, too
    distances = np.linalg.norm(points[:, None] - centres, axis=2)
    assert (distances.min(axis=1) <= radius + 1e-9).all()


def test_a_cube_needs_one_sphere_and_a_bar_three():
    assert len(cover_box((0.07, 0.07, 0.07))[0]) == 1
    assert len(cover_box((0.105, 0.035, 0.035))[0]) == 3
    assert len(cover_box((0.22, 0.21, 0.01))[0]) == 9
