"""Taking a box from above: where the tool goes, and how far the gripper opens."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from llm3_bullet.robot import Gripper, ParallelGripper, SuctionGripper
from llm3_bullet.tabletop.stance import Stance

OPENING_MARGIN = 0.008
"""Fingers open by this much more than a box is wide, in metres: 4 mm on each side."""
ABOVE_CENTER = 0.012
"""The tool centre point of fingers is this far above the box's centre, in metres: the palm then clears neighbours of
the same height."""
PALM_GAP = 0.005
"""The palm stays this far above a tall box, in metres: it is then taken higher up."""
CUP_GAP = 0.0015
"""A cup stops this far above a box, in metres: PyBullet's shapes are up to 1 mm thicker than drawn, and a lip gives."""


@dataclass(frozen=True, eq=False)
class Grasp:
    """One way to take a box."""

    tool: NDArray[np.float64]
    """(4, 4): pose of the tool frame in the world."""
    width: float = 0.0
    """Distance between the two faces that fingers grip, in metres; 0 for a cup."""


def widest(gripper: Gripper) -> float:
    """The greatest distance between two faces that fingers can take, in metres; infinite for a cup."""
    return gripper.max_opening - OPENING_MARGIN if isinstance(gripper, ParallelGripper) else np.inf


def narrowest(gripper: Gripper) -> float:
    """The narrowest upper face that a cup can take, in metres; 0 for fingers."""
    return 2 * gripper.cup_radius if isinstance(gripper, SuctionGripper) else 0.0


def top_grasps(center: NDArray[np.float64], standing: Stance, gripper: Gripper) -> tuple[Grasp, ...]:
    """All grasps from above, the preferred first.

    Fingers take the closer pair of faces first, and each pair with the hand either way round. A cup takes the middle
    of the upper face, with the hand turned by each quarter.

    Args:
        center: World position of the box's centre, (3,).
        standing: How the box stands.
        gripper: What takes it.

    Returns:
        The grasps; none if the box is too wide for the fingers both ways, or too narrow for the cup.
    """
    height = standing.extent[2]
    if isinstance(gripper, SuctionGripper):
        if min(standing.extent[:2]) < narrowest(gripper):
            return ()
        position = center + np.array((0.0, 0.0, height / 2 + CUP_GAP))
        quarters = (0.0, np.pi, np.pi / 2, -np.pi / 2)
        return tuple(Grasp(_pointing_down(position, (1.0, 0.0, 0.0), standing.yaw + turn)) for turn in quarters)
    widths = standing.extent[:2]
    pairs = sorted((0, 1), key=lambda side: widths[side])
    if widths[pairs[0]] < widths[pairs[1]]:
        pairs = pairs[:1]
    position = center + np.array((0.0, 0.0, _above_center(height, gripper)))
    return tuple(
        Grasp(_pointing_down(position, gripper.closing_axis, standing.yaw + side * np.pi / 2 + turn), widths[side])
        for side in pairs
        if widths[side] <= widest(gripper)
        for turn in (0.0, np.pi)
    )


def hand_heights(height: float, gripper: ParallelGripper) -> tuple[float, float]:
    """How high the fingers' tips and the palm are above what a box of this height stands on; all in metres."""
    tool = height / 2 + _above_center(height, gripper)
    return tool - gripper.tip_depth, tool + gripper.palm_height


def _above_center(height: float, gripper: ParallelGripper) -> float:
    return max(min(ABOVE_CENTER, height / 4), height / 2 + PALM_GAP - gripper.palm_height)


def _pointing_down(
    position: NDArray[np.float64], axis: tuple[float, float, float], angle: float
) -> NDArray[np.float64]:
    """The tool pointing down, an axis of its own, across z, along the horizontal direction at this angle."""
    along = np.array([np.cos(angle), np.sin(angle), 0.0])
    down = np.array([0.0, 0.0, -1.0])
    own = np.array(axis)
    z = np.array([0.0, 0.0, 1.0])
    world = np.column_stack([along, np.cross(down, along), down])
    tool = np.column_stack([own, np.cross(z, own), z])
    pose = np.eye(4)
    pose[:3, :3] = world @ tool.T
    pose[:3, 3] = position
    return pose


def held_width(size: tuple[float, float, float], grasp: NDArray[np.float64], gripper: Gripper) -> float:
    """The distance between the faces of a held box that fingers grip, in metres; 0 for a cup.

    Args:
        size: The box's.
        grasp: The box's pose in the tool frame, (4, 4).
        gripper: What holds it.
    """
    if isinstance(gripper, SuctionGripper):
        return 0.0
    side = int(np.argmax(np.abs(np.array(gripper.closing_axis) @ grasp[:3, :3])))
    return size[side]
