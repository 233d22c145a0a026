"""Picking and placing: the ways in which the hand can come down for each."""

from __future__ import annotations

from collections.abc import Iterable, Mapping
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from llm3.types import Event, EventKind, Failure, FailureKind, Held, Pose, State
from llm3_bullet.poses import as_matrix, as_pose
from llm3_bullet.robot import Gripper, SuctionGripper
from llm3_bullet.scene import Box, HeldBox, Scene, Size
from llm3_bullet.tabletop.grasps import OPENING_MARGIN, Grasp, held_width, narrowest, top_grasps, widest
from llm3_bullet.tabletop.stance import Stance, stance
from llm3_bullet.touchdown import Touchdown

DROP = 0.002
"""A box is let go this far above what it will stand on, in metres."""
Poses = Mapping[str, Pose]


@dataclass(frozen=True, eq=False)
class InHand:
    """A box in the hand."""

    held: Held
    standing: Stance
    """How it will stand when the hand puts it down."""


class Manipulation:
    """Turns actions into touchdowns, and states into scenes."""

    def __init__(self, sizes: Mapping[str, Size], furniture: tuple[Box, ...], gripper: Gripper) -> None:
        """Take what never changes.

        Args:
            sizes: Of all boxes, by name.
            furniture: The fixed things of the scene.
            gripper: What takes the boxes.
        """
        self._sizes, self._furniture, self._gripper = sizes, furniture, gripper

    def pick(self, state: State, name: str) -> Iterable[Touchdown] | Failure:
        """The ways to pick a box up, each made when it is asked for, or the precondition that is not met."""
        if state.held:
            return precondition(f"The gripper already holds {state.held.object}, so it cannot pick {name}.")
        pose = as_matrix(state.poses[name])
        standing = stance(pose[:3, :3], self._sizes[name])
        if standing is None:
            return precondition(f"{name} leans, so it cannot be taken from above.")
        grasps = top_grasps(pose[:3, 3], standing, self._gripper)
        if not grasps:
            return precondition(self._misfit(name))
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

    def in_hand(self, state: State, name: str, deed: str = "place") -> InHand | Failure:
        """The box in the hand, or the precondition that is not met: the hand holds no such box.

        Args:
            state: Where it begins.
            name: The box's.
            deed: What the hand is to do with it, for the sentence.
        """
        if state.held is None or state.held.object != name:
            hand = f"holds {state.held.object}" if state.held else "is empty"
            return precondition(f"The gripper {hand}, so it cannot {deed} {name}: pick {name} first.")
        standing = stance(_TOOL_DOWN @ as_matrix(state.held.grasp)[:3, :3], self._sizes[name])
        if standing is None:
            return precondition(f"{name} is held at a slant, so it cannot be placed upright.")
        return InHand(state.held, standing)

    def place(self, state: State, box: InHand, center: tuple[float, float], theta: float, below: float) -> Touchdown:
        """The way to put the held box down.

        Args:
            state: Where it begins.
            box: The box.
            center: x, y of where its centre comes, in metres.
            theta: Its rotation about the vertical then, in radians.
            below: How high what it will stand on is, in metres.
        """
        held, standing = box.held, box.standing
        grasp = as_matrix(held.grasp)
        target = np.eye(4)
        target[:3, :3] = standing.orientation(theta)
        target[:3, 3] = (*center, below + standing.extent[2] / 2 + DROP)
        opening = self._opened(self._width(held))
        released = {**state.poses, held.object: as_pose(target)}
        return Touchdown(
            target @ np.linalg.inv(grasp),
            down=self.transit_scene(state),
            up=self.scene(released, None, opening),
            after=self.scene(released, None, self._gripper.max_opening),
            before=(),
            bottom=(Event(EventKind.DETACH, object=held.object), *self.open_to(opening)),
        )

    def open_to(self, opening: float) -> tuple[Event, ...]:
        """The event of setting the fingers to an opening in metres; none for a gripper without fingers."""
        return () if isinstance(self._gripper, SuctionGripper) else (Event(EventKind.GRIPPER, opening=opening),)

    def _opened(self, width: float) -> float:
        """How far the fingers are open around something of this width, in metres."""
        return 0.0 if isinstance(self._gripper, SuctionGripper) else round(width + OPENING_MARGIN, 4)

    def _width(self, held: Held) -> float:
        return held_width(self._sizes[held.object], as_matrix(held.grasp), self._gripper)

    def transit_scene(self, state: State) -> Scene:
        """What surrounds the robot between two touchdowns: the gripper is wide open, or holds a box."""
        return self.scene(state.poses, state.held, self._width(state.held) if state.held else self._gripper.max_opening)

    def scene(self, poses: Poses, held: Held | None, opening: float) -> Scene:
        """The furniture and the boxes where they are."""
        in_hand = HeldBox(held.object, self._sizes[held.object], held.grasp) if held else None
        return Scene(self.things(poses), in_hand, opening)

    def things(self, poses: Poses) -> tuple[Box, ...]:
        """The furniture, and the boxes where they are."""
        return (*self._furniture, *(Box(name, self._sizes[name], pose) for name, pose in poses.items()))


_TOOL_DOWN = np.diag([1.0, -1.0, -1.0])


def precondition(sentence: str, *objects: str) -> Failure:
    """A precondition that is not met.

    Args:
        sentence: What the model reads.
        objects: What is to blame.
    """
    return Failure(FailureKind.PRECONDITION, sentence, objects)
