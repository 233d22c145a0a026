"""What stands where while a plan is played."""

from __future__ import annotations

from math import atan2

import numpy as np

from llm3.types import Pose, State
from llm3_tabletop2d.instance import RectangleSpec, TabletopInstance
from llm3_tabletop2d.verification.outlines import Array, Outline, deepest

FRAME = "outer_wall"


class World:
    """The table, and what the robot has taken hold of."""

    def __init__(self, instance: TabletopInstance, radius: float, start: State) -> None:
        """Put everything where the start says.

        Args:
            instance: The problem.
            radius: The robot's, in metres.
            start: Holds nothing, and says of each object where it is.
        """
        self.robot = Outline("robot", True, (2 * radius, 2 * radius))
        self.room = np.array(instance.room)
        self.at: Array = np.array(start.configuration)
        self.held: str | None = None
        self.objects = {
            item.name: Outline(item.name, item.shape == "disc", item.size, turn_of(start.poses[item.name]))
            for item in instance.objects
        }
        self.centers: dict[str, Array] = {name: np.array(pose.position[:2]) for name, pose in start.poses.items()}
        self._walls = [(_rectangle(wall), np.array(wall.center)) for wall in instance.walls]

    def move(self, to: Array) -> None:
        """Move the robot, with what it holds."""
        if self.held:
            self.centers[self.held] = self.centers[self.held] + to - self.at
        self.at = to

    def gap_to(self, name: str) -> float:
        """How far the robot is from an object, in metres; negative inside of it."""
        offset = self.centers[name] - self.at
        return -float(deepest(self.robot, self.objects[name], offset[None])[0])

    def depths(self, points: Array) -> dict[tuple[str, str], Array]:
        """How deep what moves is in what stands, at places of the robot (N, 2): (N,) for each pair."""
        moving = [(self.robot, points)]
        if self.held:
            moving.append((self.objects[self.held], points + self.centers[self.held] - self.at))
        standing = [(self.objects[name], at) for name, at in self.centers.items() if name != self.held]
        found = {}
        for mover, centers in moving:
            for other, at in (*standing, *self._walls):
                found[mover.name, other.name] = deepest(mover, other, at - centers)
            outline = mover.points + centers[:, None]
            found[mover.name, FRAME] = np.maximum(-outline, outline - self.room).max(axis=(1, 2))
        return found


def turn_of(pose: Pose) -> float:
    """How far a pose is turned about the vertical, in radians."""
    _, _, z, w = pose.orientation
    return 2 * atan2(z, w)


def _rectangle(wall: RectangleSpec) -> Outline:
    return Outline(wall.name, False, wall.size)
