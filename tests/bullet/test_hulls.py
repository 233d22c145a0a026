from __future__ import annotations

from itertools import product
from pathlib import Path

import numpy as np
import pytest
from toy_arm import URDF, toy_arm

from llm3.errors import InputError
from llm3_bullet.clients import connect
from llm3_bullet.hulls import MARGIN, link_hull
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
    assert np.prod(high - low) < 4 * 8 * np.prod(half)  # the link's inertial frame, and so the box, is tilted


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
