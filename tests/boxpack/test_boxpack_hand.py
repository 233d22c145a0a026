"""The blocks that stand for the Panda's hand: some are inside of its meshes, and others are around them."""

from __future__ import annotations

from itertools import product

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from scipy.spatial import ConvexHull

from llm3_boxpack.families.hand import FINGER_CORE, PALM_CORE, Hand
from llm3_boxpack.families.standing import Standing
from llm3_bullet.robot_files import locate
from llm3_bullet.robots import panda

HAND = Hand.of(panda().gripper)
INNER = 2.0
"""How far the inner face of a finger is from being flat, in millimetres."""
even = st.integers(10, 60).map(lambda half: 2.0 * half)
near = st.integers(-150, 150).map(float)


def vertices(name: str) -> np.ndarray:
    """Of a collision mesh, in millimetres: x across the closing direction, y along it, and z towards the tips."""
    lines = (locate(panda().urdf).parent / "meshes" / "collision" / name).read_text().splitlines()
    return 1000 * np.array([line.split()[1:4] for line in lines if line.startswith("v ")], dtype=float)


def assert_inside(corners: np.ndarray, mesh: np.ndarray) -> None:
    """Of the convex hull, which is what PyBullet tests."""
    faces = ConvexHull(mesh).equations
    assert (corners @ faces[:, :3].T + faces[:, 3] <= 0.0).all()


@pytest.mark.parametrize(("above", "reach", "width"), FINGER_CORE)
def test_what_stands_for_the_inside_of_a_finger_is_inside(above, reach, width):
    finger = vertices("finger.obj")
    z = finger[:, 2].max() - above
    assert_inside(np.array([(x, y, z) for x, y in product((-width / 2, width / 2), (INNER, reach))]), finger)


def test_what_stands_for_the_inside_of_the_palm_is_inside():
    above, along, across = PALM_CORE
    hand = vertices("hand.obj")
    z = hand[:, 2].max() - above
    assert_inside(np.array([(x, y, z) for x, y in product((-across / 2, across / 2), (-along / 2, along / 2))]), hand)


@given(even, even, even, near, near, even, even, even)
def test_where_there_is_room_nothing_is_in_the_way(dx, dy, top, x, y, other_dx, other_dy, other_top):
    box, other = Standing("box", 0.0, 0.0, dx, dy, top), Standing("other", x, y, other_dx, other_dy, other_top)
    assert not (HAND.is_free(box, (other,)) and HAND.in_the_way(box, (other,)))


@given(even, even, even, near, near)
def test_what_is_lower_than_the_tips_is_in_nobodys_way(dx, dy, top, x, y):
    box = Standing("box", 0.0, 0.0, dx, dy, top)
    low = Standing("low", x, y, 40.0, 30.0, HAND.heights(top)[0])
    assert not HAND.in_the_way(box, (low,))
