"""What is seen from above, of a domain that tells what it looks like in either way."""

from __future__ import annotations

from collections.abc import Iterator
from typing import Any

import numpy as np
from numpy.typing import NDArray

from llm3.errors import MissingCapability
from llm3.interfaces import Domain, Options, Scenery
from llm3.playback.from_above import View, seen_from_above
from llm3.types import Body, Color, Moment, Shape, State


def open_view(domain: Domain, instance: Any, options: Options, start: State, scenery: Scenery | None) -> View:
    """The shadows of a scenery, or the domain's top view where there is none.

    Args:
        domain: What the instance is of.
        instance: The problem.
        options: A value for every one of the domain's `options`.
        start: A state of the instance.
        scenery: The problem's, if it has one.

    Raises:
        MissingCapability: There is neither.
    """
    if scenery is not None:
        return projection(scenery)
    if seen_from_above(domain, instance, options, start) is None:
        raise MissingCapability(domain.name, "scenery and no top view", "a view from above")
    return lambda moment: seen_from_above(domain, instance, options, moment.state) or ()


def projection(scenery: Scenery) -> View:
    """Bodies as their shadows at noon, the robot's on top.

    Shadows are convex: that of each link of the robot, and that of each surface of other bodies.

    Args:
        scenery: Where the bodies come from.
    """
    parts = [(body, _outermost(points), color) for body in scenery.bodies for points, color in _parts(body)]

    def view(moment: Moment) -> tuple[Shape, ...]:
        places = scenery.places(moment)
        seen = []
        for body, points, color in parts:
            if body.name in places:
                where = points @ places[body.name][:3, :3].T + places[body.name][:3, 3]
                is_robot, is_fixed = body.kind == "robot", body.kind == "fixed"
                corners: tuple[tuple[float, float], ...] = tuple(map(tuple, _convex(where[:, :2]).tolist()))
                seen.append((is_robot, float(where[:, 2].max()), Shape(body.name, corners, is_fixed, color, is_robot)))
        return tuple(shape for *_, shape in sorted(seen, key=lambda item: item[:2]))

    return view


def _parts(body: Body) -> Iterator[tuple[NDArray[np.float64], Color]]:
    """The points, shape (N, 3), and the colour of each part that has a shadow of its own."""
    if body.kind == "robot":  # whose links have many surfaces each
        yield np.vstack([surface.corners for surface in body.surfaces]), body.surfaces[0].color
    else:
        yield from ((surface.corners, surface.color) for surface in body.surfaces)


def _convex(points: NDArray[np.float64]) -> NDArray[np.float64]:
    """The corners of the convex hull, shape (N, 2), counter-clockwise; of points on a line a box around them."""
    from scipy.spatial import ConvexHull, QhullError

    try:
        return np.asarray(points[ConvexHull(points).vertices])
    except QhullError:
        (left, bottom), (right, top) = points.min(axis=0), points.max(axis=0)
        return np.array([(left, bottom), (right, bottom), (right, top), (left, top)])


def _outermost(points: NDArray[np.float64]) -> NDArray[np.float64]:
    """Those of the points, shape (N, 3), that shape the shadows, whichever way they are turned: meshes have many."""
    from scipy.spatial import ConvexHull, QhullError

    try:
        return np.asarray(points[ConvexHull(points).vertices])
    except QhullError:  # they are flat
        return points
