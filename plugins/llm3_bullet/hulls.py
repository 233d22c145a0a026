"""The collision hulls of a robot's links, as PyBullet holds them."""

from __future__ import annotations

from collections.abc import Sequence
from itertools import product

import numpy as np
from numpy.typing import NDArray
from scipy.spatial import ConvexHull

from llm3_bullet.clients import BulletClient

Array = NDArray[np.float64]

MARGIN = 0.001
"""Metres by which PyBullet thickens the hull of a mesh."""
_CUBE = np.array(list(product((-1.0, 1.0), repeat=3)))


def link_hull(client: BulletClient, body: int, link: int) -> Array:
    """Points whose convex hull, thickened by `MARGIN`, covers all that collides of a link.

    A mesh gives its vertices, which PyBullet wraps in a convex hull. Boxes, spheres and capsules give the corners of
    the boxes around them. Anything else gives the corners of the bounding box that PyBullet reports, which lies along
    the world's axes.

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
    halves = [_half_extent(client, kind, size) for _, _, kind, size, *_ in shapes]
    if all(half is not None for half in halves):
        boxes = [_transformed(client, shape[5:7], _CUBE * half) for shape, half in zip(shapes, halves, strict=True)]
        return _transformed(client, client.getDynamicsInfo(body, link)[3:5], np.concatenate(boxes))
    corners = np.array(list(product(*zip(*client.getAABB(body, link), strict=True))))
    return _transformed(client, client.invertTransform(*_link_frame(client, body, link)), corners)


def _half_extent(client: BulletClient, kind: int, size: Sequence[float]) -> Array | None:
    """Half of the sides of the box around a shape of this kind, (3,); None for other kinds."""
    if kind == client.GEOM_BOX:
        return np.array(size) / 2
    if kind == client.GEOM_SPHERE:
        return np.full(3, size[0])
    if kind == client.GEOM_CAPSULE:
        length, radius = size[:2]
        return np.array((radius, radius, radius + length / 2))
    return None


def thickened(points: Array, thickness: float) -> Array:
    """Points whose convex hull covers all that is no farther than a thickness from the convex hull of these points.

    A corner moves outwards until it is beyond all faces that meet in it, shifted by the thickness. That is enough: a
    unit vector u between these faces' normals n is a sum of λ n with Σ λ ≥ 1, so with n · d ≥ thickness for a move d,
    u · d ≥ thickness too. Where the faces meet at so sharp an angle that the corner would move far, it becomes a cube.

    Args:
        points: (V, 3), not all in one plane, in metres.
        thickness: In metres.

    Returns:
        (C, 3): one point for each corner of the hull, but for the sharpest.
    """
    hull = ConvexHull(points)
    normals = hull.equations[:, :3]
    outwards = np.zeros(points.shape)
    np.add.at(outwards, hull.simplices, normals[:, None])
    corners = hull.vertices
    outwards[corners] /= np.linalg.norm(outwards[corners], axis=1, keepdims=True)
    least = np.full(len(points), np.inf)  # cosine of the widest angle to the normal of a face
    np.minimum.at(least, hull.simplices, np.einsum("fvi,fi->fv", outwards[hull.simplices], normals))
    blunt, sharp = corners[least[corners] > 0.4], corners[least[corners] <= 0.4]
    cube = np.array(list(product((-thickness, thickness), repeat=3)))
    moved = points[blunt] + thickness * outwards[blunt] / least[blunt, None]
    return np.concatenate([moved, (points[sharp, None] + cube).reshape(-1, 3)])


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
