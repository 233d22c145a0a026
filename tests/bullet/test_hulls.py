from __future__ import annotations

from itertools import product
from pathlib import Path

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from scipy.spatial import ConvexHull
from toy_arm import URDF, toy_arm

from llm3.errors import InputError
from llm3_bullet.clients import connect
from llm3_bullet.hulls import MARGIN, link_hull, thickened
from llm3_bullet.model import RobotModel
from llm3_bullet.narrowphase import Narrowphase

BOX = '<box size="0.2 0.3 0.1"/>'
"""The shape of the toy arm's first link, whose centre is 5 cm above the link's frame."""


def write_mesh(folder, corners) -> None:
    """A mesh with a triangle fan over the corners."""
    vertices = "".join(f"v {x} {y} {z}\n" for x, y, z in corners)
    faces = "".join(f"f 1 {i} {i + 1}\n" for i in range(2, len(corners)))
    (folder / "shape.obj").write_text(vertices + faces)


def hull_of(folder, shape: str) -> np.ndarray:
    (folder / "arm.urdf").write_text(URDF.replace(BOX, shape))
    with connect() as client:
        return link_hull(client, client.loadURDF(str(folder / "arm.urdf"), useFixedBase=True), -1)


def extent(points: np.ndarray) -> np.ndarray:
    return np.array([points.min(axis=0), points.max(axis=0)])


@pytest.mark.parametrize(
    ("shape", "half"),
    [
        (BOX, (0.1, 0.15, 0.05)),
        ('<sphere radius="0.1"/>', (0.1,) * 3),
        ('<cylinder radius="0.1" length="0.3"/>', (0.1, 0.1, 0.15)),
    ],
)
def test_a_primitive_shape_is_covered_by_a_box(tmp_path, shape, half):
    low, high = extent(hull_of(tmp_path, shape))
    assert (low <= np.array((0.0, 0.0, 0.05)) - half + 1e-9).all()
    assert (high >= np.array((0.0, 0.0, 0.05)) + half - 1e-9).all()
    assert np.prod(high - low) < 4 * 8 * np.prod(half)  # what PyBullet gives for a cylinder is tilted


@pytest.mark.parametrize(
    ("shape", "half"),
    [
        (BOX, (0.1, 0.15, 0.05)),
        ('<sphere radius="0.1"/>', (0.1,) * 3),
        ('<capsule radius="0.1" length="0.3"/>', (0.1, 0.1, 0.25)),
    ],
)
def test_a_box_around_a_shape_is_tight_however_the_robot_stands(tmp_path, shape, half):
    (tmp_path / "arm.urdf").write_text(URDF.replace(BOX, shape))
    with connect() as client:
        turned = client.getQuaternionFromEuler((0.3, 0.4, 0.5))
        hull = link_hull(client, client.loadURDF(str(tmp_path / "arm.urdf"), (1, 2, 3), turned, useFixedBase=True), -1)
    np.testing.assert_allclose(extent(hull), np.array((0.0, 0.0, 0.05)) + np.outer((-1, 1), half), atol=1e-9)


def test_two_shapes_of_a_link_are_covered_by_two_boxes(tmp_path):
    second = '<collision><origin xyz="0 0 0.3"/><geometry><sphere radius="0.02"/></geometry></collision>'
    text = URDF.replace(f"<geometry>{BOX}</geometry></collision>", f"<geometry>{BOX}</geometry></collision>{second}")
    (tmp_path / "arm.urdf").write_text(text)
    with connect() as client:
        hull = link_hull(client, client.loadURDF(str(tmp_path / "arm.urdf"), useFixedBase=True), -1)
    np.testing.assert_allclose(extent(hull), [(-0.1, -0.15, 0.0), (0.1, 0.15, 0.32)], atol=1e-9)


def test_a_mesh_gives_its_vertices_in_the_link_s_frame(tmp_path):
    corners = np.array(list(product((0.0, 0.1), (0.0, 0.2), (0.0, 0.3))))
    write_mesh(tmp_path, corners)
    hull = hull_of(tmp_path, '<mesh filename="shape.obj"/>')
    np.testing.assert_allclose(extent(hull), extent(corners + np.array([0.0, 0.0, 0.05])), atol=1e-6)


def test_a_flat_mesh_is_given_a_thickness(tmp_path):
    corners = np.array([[0, 0, 0], [0.1, 0, 0], [0.1, 0.2, 0], [0, 0.2, 0]])
    write_mesh(tmp_path, corners)
    hull = hull_of(tmp_path, '<mesh filename="shape.obj"/>')
    low, high = extent(hull)
    assert np.linalg.matrix_rank(hull - hull[0], tol=1e-5) == 3
    assert (low <= (MARGIN, MARGIN, 0.05)).all()
    assert (high >= (0.1 - MARGIN, 0.2 - MARGIN, 0.05)).all()


def test_a_link_without_a_shape_has_no_hull(checkers):
    for checker in checkers.values():
        assert len(checker.hulls[checker.kinematics.model.tool]) == 0


def test_a_missing_mesh_is_one_line(tmp_path):
    description = toy_arm(tmp_path)
    Path(description.urdf).write_text(URDF.replace(BOX, '<mesh filename="nowhere.obj"/>'))
    with connect() as client, pytest.raises(InputError) as caught:
        Narrowphase(client, RobotModel(description))
    assert str(caught.value) == (
        f"PyBullet cannot load the robot file {description.urdf}: a shape in it, or a mesh file that it names, is "
        f"missing or broken."
    )


@settings(max_examples=50, deadline=None)
@given(seed=st.integers(0, 2**32), count=st.integers(5, 60), thickness=st.floats(0.001, 0.05))
def test_what_is_thickened_covers_all_within_the_thickness(seed, count, thickness):
    rng = np.random.default_rng(seed)
    points = rng.normal(size=(count, 3)) * rng.uniform(0.02, 0.3, 3)
    faces = ConvexHull(thickened(points, thickness)).equations
    inside = rng.dirichlet(np.full(count, 0.1), 300) @ points
    directions = rng.normal(size=(300, 3))
    directions /= np.linalg.norm(directions, axis=1, keepdims=True)
    for reached in (points[:, None] + thickness * directions, inside + thickness * directions):
        assert (reached.reshape(-1, 3) @ faces[:, :3].T + faces[:, 3] <= 1e-9).all()


def test_a_thickened_box_is_a_larger_box():
    points = np.array(list(product((0.0, 0.1), (0.0, 0.2), (0.0, 0.3))))
    thicker = thickened(points, 0.01)
    assert len(thicker) == 8
    middle = points.mean(axis=0)
    assert np.abs(thicker - middle).max(axis=0) == pytest.approx(np.array([0.05, 0.1, 0.15]) + 0.01, abs=0.01)


def test_a_sharp_corner_does_not_run_away():
    needle = np.array([[0, 0, 1.0], [0.01, 0, 0], [-0.01, 0.01, 0], [-0.01, -0.01, 0]])
    assert thickened(needle, 0.01)[:, 2].max() <= 1.01 + 1e-12
