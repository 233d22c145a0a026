"""The collision hulls of a robot's links, as PyBullet holds them."""

from __future__ import annotations

from itertools import product

import numpy as np
from numpy.typing import NDArray

from llm3_bullet.clients import BulletClient

Array = NDArray[np.float64]

MARGIN = 0.001
"""Metres by which PyBullet thickens the hull of a mesh."""


def link_hull(client: BulletClient, body: int, link: int) -> Array:
    """Points whose convex hull, thickened by `MARGIN`, covers all that collides of a link.

    A mesh gives its vertices, which PyBullet wraps in a convex hull. Any other shape, and several shapes on one
    link, give the corners of the bounding box that PyBullet reports.

    Args:
        client: The world.
        body: PyBullet's number of the robot.
        link: PyBullet's number of the link, -1 for the base.

    Returns:
        (V, 3) in metres in the URDF's link frame; V is 0 for a link without a collision shape.
    """
    shapes = client.getCollisionShapeData(body, link)
    if not shapes:
        return np.empty((0, 3))
    if len(shapes) == 1 and shapes[0][2] == client.GEOM_MESH:
        vertices = np.array(client.getMeshData(body, link)[1], dtype=float).reshape(-1, 3)
        if len(vertices) and np.linalg.matrix_rank(vertices - vertices[0], tol=1e-5) == 3:
            return _transformed(client, client.getDynamicsInfo(body, link)[3:5], vertices)
    corners = np.array(list(product(*zip(*client.getAABB(body, link), strict=True))))
    return _transformed(client, client.invertTransform(*_link_frame(client, body, link)), corners)


def _link_frame(client: BulletClient, body: int, link: int) -> tuple[Array, Array]:
    """World position and orientation of the URDF's link frame."""
    if link >= 0:
        position, orientation = client.getLinkState(body, link, computeForwardKinematics=True)[4:6]
    else:
        centre_of_mass = client.getBasePositionAndOrientation(body)
        in_link = client.invertTransform(*client.getDynamicsInfo(body, link)[3:5])
        position, orientation = client.multiplyTransforms(*centre_of_mass, *in_link)
    return position, orientation


def _transformed(client: BulletClient, frame: tuple[Array, Array], points: Array) -> Array:
    position, orientation = frame
    rotation = np.array(client.getMatrixFromQuaternion(orientation)).reshape(3, 3)
    moved: Array = points @ rotation.T + position
    return moved
