"""The table in three dimensions: every outline has a height, so that it can be walked around."""

from __future__ import annotations

from collections.abc import Mapping
from math import cos, sin

import numpy as np

from llm3.interfaces import Frame, Scenery
from llm3.types import Body, Camera, Color, Moment, Pose, Shape, State, color_of, prism_surface
from llm3_tabletop2d.instance import TabletopInstance
from llm3_tabletop2d.scene import ROBOT, turn_of
from llm3_tabletop2d.top_view import top_view

FLAT, LOW, HIGH = 0.004, 0.05, 0.08
"""Heights in metres: of regions, of objects and the robot, of walls."""


class TabletopScenery(Scenery):
    """The outlines of the view from above, as prisms that stand on the table."""

    def __init__(self, instance: TabletopInstance, radius: float) -> None:
        """Take the problem, and the robot's radius in metres."""
        self._instance = instance
        poses = {item.name: Pose((0.0, 0.0, 0.0)) for item in instance.objects}
        flat = {region.name for region in instance.regions} | {"room"}
        shapes = top_view(instance, radius, State(poses, (0.0, 0.0)))
        self._heights = {s.name: FLAT if s.name in flat else HIGH if s.fixed else LOW for s in shapes}
        self._bodies = tuple(self._body(shape) for shape in shapes)

    @property
    def bodies(self) -> tuple[Body, ...]:
        """The room, the regions, the walls, the objects and the robot."""
        return self._bodies

    @property
    def camera(self) -> Camera:
        """From above and a little from the front."""
        x, y = self._instance.room
        return Camera((x / 2, y / 2, 0.0), 1.3 * max(x, y), yaw=0.0, pitch=-60.0)

    def places(self, moment: Moment) -> Mapping[str, Frame]:
        """Everything stands on the table, but for the room, which is the table."""
        x, y = moment.configuration
        poses = dict(moment.poses)
        if moment.held:
            dx, dy, _ = moment.held.grasp.position
            poses[moment.held.object] = Pose((x + dx, y + dy, 0.0), moment.held.grasp.orientation)
        poses[ROBOT] = Pose((x, y, 0.0))
        return {body.name: self._frame(body.name, poses.get(body.name)) for body in self._bodies}

    def _body(self, shape: Shape) -> Body:
        color: Color = shape.color or color_of(shape.name)
        surface = prism_surface(shape.corners, self._heights[shape.name], color)
        return Body(shape.name, (surface,), "robot" if shape.robot else "fixed" if shape.fixed else "object")

    def _frame(self, name: str, pose: Pose | None) -> Frame:
        x, y, _ = pose.position if pose else (0.0, 0.0, 0.0)
        height = self._heights[name]
        frame = np.eye(4)
        frame[:3, 3] = x, y, -height / 2 if name == "room" else height / 2
        if pose:
            c, s = cos(turn_of(pose)), sin(turn_of(pose))
            frame[:2, :2] = (c, -s), (s, c)
        return frame
