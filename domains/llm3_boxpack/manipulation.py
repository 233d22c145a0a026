"""Picking and placing: the ways in which the hand can come down for each."""

from __future__ import annotations

from collections.abc import Iterable, Mapping

import numpy as np
from numpy.typing import NDArray

from llm3.types import Event, EventKind, Failure, FailureKind, Held, Pose, State
from llm3_boxpack.grasps import OPENING_MARGIN, Grasp, held_width, narrowest, top_grasps, widest
from llm3_boxpack.instance import BasketSpec, BoxSpec
from llm3_boxpack.layout import stance, support_height
from llm3_bullet.poses import as_matrix, as_pose
from llm3_bullet.robot import Gripper, SuctionGripper
from llm3_bullet.scene import Box, HeldBox, Scene
from llm3_bullet.touchdown import Touchdown

DROP = 0.002
"""A box is let go this far above what it will stand on, in metres."""
Poses = Mapping[str, Pose]


class Manipulation:
    """Turns actions into touchdowns, and states into scenes."""

    def __init__(
        self,
        boxes: Mapping[str, BoxSpec],
        furniture: tuple[Box, ...],
        basket: BasketSpec,
        gripper: Gripper,
    ) -> None:
        """Take what never changes.

        Args:
            boxes: All boxes by name.
            furniture: The fixed things of the scene.
            basket: Where the boxes belong.
            gripper: What takes them.
        """
        self._boxes, self._furniture, self._basket, self._gripper = boxes, furniture, basket, gripper

    def pick(self, state: State, name: str) -> Iterable[Touchdown] | Failure:
        """The ways to pick a box up, each made when it is asked for, or the precondition that is not met."""
        if state.held:
            return _precondition(f"The gripper already holds {state.held.object}, so it cannot pick {name}.")
        box, pose = self._boxes[name], as_matrix(state.poses[name])
        standing = stance(pose[:3, :3], box.size)
        if standing is None:
            return _precondition(f"{name} leans, so it cannot be taken from above.")
        grasps = top_grasps(pose[:3, 3], standing, self._gripper)
        if not grasps:
            return _precondition(self._misfit(name))
        return (self._pick(state.poses, name, pose, grasp) for grasp in grasps)

    def _pick(self, poses: Poses, name: str, pose: NDArray[np.float64], grasp: Grasp) -> Touchdown:
        held = Held(name, as_pose(np.linalg.inv(grasp.tool) @ pose))
        others = {other: p for other, p in poses.items() if other != name}
        opening = self._opened(grasp.width)
        lifted = self.scene(others, held, grasp.width)
        return Touchdown(
            grasp.tool,
            down=self.scene(poses, None, opening),
            up=lifted,
            after=lifted,
            before=self.open_to(opening),
            bottom=(*self.open_to(grasp.width), Event(EventKind.ATTACH, object=name, grasp=held.grasp)),
        )

    def _misfit(self, name: str) -> str:
        """Why the gripper has no way to take a box."""
        if isinstance(self._gripper, SuctionGripper):
            return f"{name} is too narrow for the suction cup, which takes from {narrowest(self._gripper):g} m."
        return f"{name} is too wide for the gripper, which takes up to {widest(self._gripper):g} m."

    def place(self, state: State, name: str, x: float, y: float, theta: float) -> Iterable[Touchdown] | Failure:
        """The way to put the held box down, or the precondition that is not met."""
        if state.held is None or state.held.object != name:
            hand = f"holds {state.held.object}" if state.held else "is empty"
            return _precondition(f"The gripper {hand}, so it cannot place {name}: pick {name} first.")
        box, grasp = self._boxes[name], as_matrix(state.held.grasp)
        standing = stance(_TOOL_DOWN @ grasp[:3, :3], box.size)
        if standing is None:
            return _precondition(f"{name} is held at a slant, so it cannot be placed upright.")
        below = support_height(self._basket, standing.footprint((x, y), theta))
        target = np.eye(4)
        target[:3, :3] = standing.orientation(theta)
        target[:3, 3] = (x, y, below + standing.extent[2] / 2 + DROP)
        opening = self._opened(held_width(box.size, grasp, self._gripper))
        released = {**state.poses, name: as_pose(target)}
        down = Touchdown(
            target @ np.linalg.inv(grasp),
            down=self.transit_scene(state),
            up=self.scene(released, None, opening),
            after=self.scene(released, None, self._gripper.max_opening),
            before=(),
            bottom=(Event(EventKind.DETACH, object=name), *self.open_to(opening)),
        )
        return (down,)

    def open_to(self, opening: float) -> tuple[Event, ...]:
        """The event of setting the fingers to an opening in metres; none for a gripper without fingers."""
        return () if isinstance(self._gripper, SuctionGripper) else (Event(EventKind.GRIPPER, opening=opening),)

    def _opened(self, width: float) -> float:
        """How far the fingers are open around something of this width, in metres."""
        return 0.0 if isinstance(self._gripper, SuctionGripper) else round(width + OPENING_MARGIN, 4)

    def transit_scene(self, state: State) -> Scene:
        """What surrounds the robot between two touchdowns: the gripper is wide open, or holds a box."""
        return self.scene(state.poses, state.held, self.transit_opening(state))

    def transit_opening(self, state: State) -> float:
        """How far the gripper is open between two touchdowns, in metres."""
        if state.held is None:
            return self._gripper.max_opening
        return held_width(self._boxes[state.held.object].size, as_matrix(state.held.grasp), self._gripper)

    def scene(self, poses: Poses, held: Held | None, opening: float) -> Scene:
        """The furniture and the boxes where they are."""
        in_hand = HeldBox(held.object, self._boxes[held.object].size, held.grasp) if held else None
        return Scene((*self._furniture, *self.movable(poses)), in_hand, opening)

    def movable(self, poses: Poses) -> tuple[Box, ...]:
        """The boxes where they are."""
        return tuple(Box(name, self._boxes[name].size, pose) for name, pose in poses.items())


_TOOL_DOWN = np.diag([1.0, -1.0, -1.0])


def _precondition(sentence: str) -> Failure:
    return Failure(FailureKind.PRECONDITION, sentence)
