"""The table, seen from above."""

from __future__ import annotations

from collections.abc import Iterable
from math import cos, pi, sin

from llm3.types import Pose, Shape, State
from llm3_tabletop2d.instance import ObjectSpec, RectangleSpec, TabletopInstance
from llm3_tabletop2d.scene import turn_of

CORNERS = 48
"""Of the polygon that stands for a disc."""


def top_view(instance: TabletopInstance, state: State) -> tuple[Shape, ...]:
    """The room, the walls, the regions, and the objects that are not held."""
    width, height = instance.room
    room = Shape("room", ((0.0, 0.0), (width, 0.0), (width, height), (0.0, height)), fixed=True)
    fixed = (Shape(thing.name, _corners(thing), fixed=True) for thing in (*instance.regions, *instance.walls))
    items = ((item, state.poses.get(item.name)) for item in instance.objects)
    return (room, *fixed, *(Shape(item.name, _outline(item, pose)) for item, pose in items if pose))


def _corners(thing: RectangleSpec) -> tuple[tuple[float, float], ...]:
    (left, right), (bottom, top) = thing.ranges
    return (left, bottom), (right, bottom), (right, top), (left, top)


def _outline(item: ObjectSpec, pose: Pose) -> tuple[tuple[float, float], ...]:
    a, b = item.size[0] / 2, item.size[1] / 2
    points: Iterable[tuple[float, float]] = ((-a, -b), (a, -b), (a, b), (-a, b))
    if item.shape == "disc":
        points = ((a * cos(2 * pi * i / CORNERS), a * sin(2 * pi * i / CORNERS)) for i in range(CORNERS))
    c, s = cos(turn_of(pose)), sin(turn_of(pose))
    x, y = pose.position[:2]
    return tuple((x + c * u - s * v, y + s * u + c * v) for u, v in points)
