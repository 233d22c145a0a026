"""What stands where in a state, as bodies."""

from __future__ import annotations

from math import atan2, cos, sin

import numpy as np

from llm3.types import Pose, State, Vector
from llm3_tabletop2d.bodies import Body
from llm3_tabletop2d.instance import OUTER_WALL, ObjectSpec, TabletopInstance

THICKNESS = 1.0
"""Of the wall around the room, in metres: nothing that starts inside gets past it."""
ROBOT = "robot"
DECIMALS = 4
"""The grid of states: 0.1 mm."""


class Scene:
    """The bodies of one problem."""

    def __init__(self, instance: TabletopInstance, radius: float) -> None:
        """Take the problem and the robot's radius in metres."""
        self.items = {item.name: item for item in instance.objects}
        self.robot = Body(ROBOT, (0.0, 0.0), radius=radius)
        (x, y), t = instance.room, THICKNESS
        frame = (
            ((-t / 2, y / 2), (t, y + 2 * t)),
            ((x + t / 2, y / 2), (t, y + 2 * t)),
            ((x / 2, -t / 2), (x + 2 * t, t)),
            ((x / 2, y + t / 2), (x + 2 * t, t)),
        )
        self._walls = (
            *(Body(OUTER_WALL, center, sides) for center, sides in frame),
            *(Body(wall.name, wall.center, wall.size) for wall in instance.walls),
        )

    def body(self, name: str, pose: Pose) -> Body:
        """An object at a pose, whose position may be counted from anything."""
        return body_of(self.items[name], pose)

    def standing(self, state: State, without: str = "") -> tuple[Body, ...]:
        """The walls, and the objects that nobody holds."""
        objects = (self.body(name, pose) for name, pose in state.poses.items() if name != without)
        return (*self._walls, *objects)

    def moving(self, held: Body | None) -> tuple[Body, ...]:
        """The robot and what moves along with it, counted from the robot's centre."""
        return (self.robot, held) if held else (self.robot,)


def body_of(item: ObjectSpec, pose: Pose) -> Body:
    """An object at a pose."""
    center = (pose.position[0], pose.position[1])
    if item.shape == "disc":
        return Body(item.name, center, radius=item.size[0] / 2)
    return Body(item.name, center, item.size, turn_of(pose))


def pose_at(x: float, y: float, theta: float) -> Pose:
    """A pose in the plane."""
    return Pose((x, y, 0.0), (0.0, 0.0, sin(theta / 2), cos(theta / 2)))


def turn_of(pose: Pose) -> float:
    """How far a pose is turned about the vertical, in radians."""
    return 2 * atan2(pose.orientation[2], pose.orientation[3])


def xy(pose: Pose) -> Vector:
    """Where a pose is in the plane, (2,)."""
    return np.array(pose.position[:2])


def shifted(pose: Pose, by: Vector) -> Pose:
    """A pose elsewhere, turned alike."""
    x, y = xy(pose) + by
    return Pose((float(x), float(y), 0.0), pose.orientation)


def rounded(point: Vector) -> Vector:
    """A point on the grid of states, so that what was checked is what is."""
    return np.round(point, DECIMALS) + 0.0
