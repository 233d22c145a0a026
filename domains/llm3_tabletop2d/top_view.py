"""The table, seen from above."""

from __future__ import annotations

from math import cos, pi, sin

from llm3.types import Color, Pose, Shape, State
from llm3_tabletop2d.instance import ObjectSpec, RectangleSpec, TabletopInstance
from llm3_tabletop2d.scene import ROBOT, turn_of

CORNERS = 48
"""Of the polygon that stands for a disc."""


SMALLEST = 0.004
"""The radius in metres as which a robot that is a point is drawn."""
FLOOR: Color = (1.0, 1.0, 1.0)
REGION: Color = (0.93, 0.90, 0.83)
WALL: Color = (0.27, 0.27, 0.27)


def top_view(instance: TabletopInstance, radius: float, state: State) -> tuple[Shape, ...]:
    """The room, the regions, the walls, the objects, and the robot with what it holds.

    Args:
        instance: The problem.
        radius: The robot's, in metres.
        state: What is where.
    """
    width, height = instance.room
    room = Shape("room", ((0.0, 0.0), (width, 0.0), (width, height), (0.0, height)), fixed=True, color=FLOOR)
    regions = (Shape(region.name, _corners(region), fixed=True, color=REGION) for region in instance.regions)
    walls = (Shape(wall.name, _corners(wall), fixed=True, color=WALL) for wall in instance.walls)
    x, y = state.configuration
    poses = dict(state.poses)
    if state.held:
        dx, dy, _ = state.held.grasp.position
        poses[state.held.object] = Pose((x + dx, y + dy, 0.0), state.held.grasp.orientation)
    items = (Shape(item.name, _outline(item, poses[item.name])) for item in instance.objects if item.name in poses)
    robot = Shape(ROBOT, _circle((x, y), max(radius, SMALLEST)), robot=True)
    return (room, *regions, *walls, *items, robot)


def _corners(thing: RectangleSpec) -> tuple[tuple[float, float], ...]:
    (left, right), (bottom, top) = thing.ranges
    return (left, bottom), (right, bottom), (right, top), (left, top)


def _outline(item: ObjectSpec, pose: Pose) -> tuple[tuple[float, float], ...]:
    a, b = item.size[0] / 2, item.size[1] / 2
    x, y = pose.position[:2]
    if item.shape == "disc":
        return _circle((x, y), a)
    c, s = cos(turn_of(pose)), sin(turn_of(pose))
    return tuple((x + c * u - s * v, y + s * u + c * v) for u, v in ((-a, -b), (a, -b), (a, b), (-a, b)))


def _circle(center: tuple[float, float], radius: float) -> tuple[tuple[float, float], ...]:
    angles = (2 * pi * i / CORNERS for i in range(CORNERS))
    return tuple((center[0] + radius * cos(angle), center[1] + radius * sin(angle)) for angle in angles)
