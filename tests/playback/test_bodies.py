"""Surfaces are closed, look outwards, and refuse what makes none."""

from __future__ import annotations

from math import cos, pi, sin

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from llm3.types import Body, Surface, box_surface, prism_surface

sides = st.floats(0.01, 3)


def volume(surface):
    """What a closed surface encloses; negative if it looks inwards."""
    a, b, c = (surface.corners[surface.triangles[:, i]] for i in range(3))
    return np.einsum("ij,ij->i", a, np.cross(b, c)).sum() / 6


def edges(surface):
    return [tuple(t[[i, (i + 1) % 3]]) for t in surface.triangles for i in range(3)]


@given(sides, sides, sides)
def test_a_box_is_closed_and_has_its_size(x, y, z):
    box = box_surface((x, y, z))
    assert volume(box) == pytest.approx(x * y * z)
    assert np.allclose(np.ptp(box.corners, axis=0), (x, y, z))
    assert np.allclose(box.corners.mean(axis=0), 0)
    assert sorted(edges(box)) == sorted((b, a) for a, b in edges(box))


@given(st.integers(3, 40), sides, sides)
def test_a_prism_is_closed_and_has_its_volume(count, radius, height):
    outline = [(radius * cos(2 * pi * i / count), radius * sin(2 * pi * i / count)) for i in range(count)]
    prism = prism_surface(outline, height)
    assert volume(prism) == pytest.approx(count / 2 * radius**2 * sin(2 * pi / count) * height)
    assert sorted(edges(prism)) == sorted((b, a) for a, b in edges(prism))


WRONG = [
    (
        (np.zeros((4, 2)), np.zeros((1, 3))),
        "a surface has corners of shape (N, 3) and triangles of shape (M, 3), not (4, 2) and (1, 3)",
    ),
    ((np.full((3, 3), np.nan), [(0, 1, 2)]), "the corners of a surface must be finite"),
    (
        (np.zeros((3, 3)), [(0, 1, 3)]),
        "the triangles of a surface go by the numbers of its 3 corners, from 0",
    ),
]


@pytest.mark.parametrize(("parts", "sentence"), WRONG)
def test_what_makes_no_surface_is_refused(parts, sentence):
    with pytest.raises(ValueError) as error:
        Surface(*parts)
    assert str(error.value) == sentence


def test_a_body_can_be_seen():
    with pytest.raises(ValueError, match="body 'ghost' needs at least one surface: leave out what cannot be seen"):
        Body("ghost", ())
