"""Which boxes are in one another, told from points in them."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from llm3.types import Pose
from llm3_bullet.poses import as_matrix
from llm3_bullet.scene import Box
from llm3_bullet.tabletop.overlaps import RESTING, depth, overlap

LATTICE = np.stack(np.meshgrid(*[np.linspace(-0.5, 0.5, 13)] * 3), axis=-1).reshape(-1, 3)
coordinates = st.floats(-0.15, 0.15)
sides = st.floats(0.02, 0.3)


@st.composite
def boxes(draw):
    turn = np.add(draw(st.tuples(*[st.floats(-1, 1)] * 4)), (0.0, 0.0, 0.0, 1.1))
    pose = Pose(draw(st.tuples(*[coordinates] * 3)), tuple(turn / np.linalg.norm(turn)))
    return Box("box", draw(st.tuples(*[sides] * 3)), pose)


def cube(name: str, x: float, y: float, z: float, side: float = 0.1) -> Box:
    return Box(name, (side, side, side), Pose((x, y, z)))


def moved(box: Box, way: tuple[float, float, float]) -> Box:
    return replace(box, pose=replace(box.pose, position=tuple(np.add(box.pose.position, way))))


@given(boxes(), boxes())
def test_boxes_with_a_point_in_common_are_in_one_another(first, second):
    points = np.column_stack([LATTICE * first.size, np.ones(len(LATTICE))]) @ as_matrix(first.pose).T
    local = (points @ np.linalg.inv(as_matrix(second.pose)).T)[:, :3]
    if (np.abs(local) < np.array(second.size) / 2).all(axis=1).any():
        assert depth(first, second) > 0


@given(boxes(), boxes())
def test_it_is_the_same_either_way_round(first, second):
    assert depth(first, second) == pytest.approx(depth(second, first), abs=1e-12)


@given(boxes(), boxes(), st.tuples(*[st.floats(-0.1, 0.1)] * 3))
def test_no_way_out_is_shorter_than_the_depth(first, second, way):
    apart = moved(second, way)
    shift = float(np.linalg.norm(np.subtract(apart.pose.position, second.pose.position)))
    assert depth(first, apart) >= depth(first, second) - shift - 1e-9


@pytest.mark.parametrize(("z", "deep"), [(0.15, 0.0), (0.149, 0.001), (0.16, -0.01), (0.13, 0.02)])
def test_of_cubes_above_one_another_it_is_the_difference_of_heights(z, deep):
    assert depth(cube("a", 0.0, 0.0, 0.05), cube("b", 0.02, 0.0, z)) == pytest.approx(deep, abs=1e-9)


def test_edges_that_cross_are_told_apart():
    """No face of either separates them: two bars that lie across each other, each standing on an edge."""
    bar = (1.0, 0.1, 0.1)
    first = Box("a", bar, Pose((0.0, 0.0, 0.0), (np.sin(np.pi / 8), 0.0, 0.0, np.cos(np.pi / 8))))
    quarter = np.sqrt(0.5)
    lying = np.array((np.sin(np.pi / 8), 0.0, 0.0, np.cos(np.pi / 8)))
    across = (quarter * lying[0], quarter * lying[0], quarter * lying[3], quarter * lying[3])
    for height, deep in ((0.142, -0.0006), (0.141, 0.0004)):  # half of the diagonal twice: 0.1414
        second = Box("b", bar, Pose((0.0, 0.0, height), across))
        assert depth(first, second) == pytest.approx(deep, abs=1e-4)


def test_what_rests_or_stands_side_by_side_is_not_in_one_another():
    tower = [cube("a", 0.0, 0.0, 0.05), cube("b", 0.0, 0.0, 0.15), cube("c", 0.1, 0.0, 0.05)]
    ground = Box("table", (2.0, 2.0, 0.1), Pose((0.0, 0.0, -0.05)), fixed=True)
    assert overlap(tower, [ground]) is None
    assert overlap([*tower, cube("d", 0.0, 0.1, 0.05 - RESTING + 1e-4)], [ground]) is None


def test_the_first_box_that_is_in_something_is_named_last():
    ground = Box("table", (2.0, 2.0, 0.1), Pose((0.0, 0.0, -0.05)), fixed=True)
    stacked = [cube("a", 0.0, 0.0, 0.05), cube("b", 0.09, 0.0, 0.05)]
    assert overlap(stacked, [ground]) == ("a", "b")
    assert overlap([cube("a", 0.0, 0.0, 0.04)], [ground]) == ("table", "a")
    assert overlap([], [ground, ground]) is None
