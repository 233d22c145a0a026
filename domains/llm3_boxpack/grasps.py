"""Taking a box from above: where the tool goes, and how far the gripper opens."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from llm3_boxpack.layout import Stance
from llm3_bullet.robot import ParallelGripper

OPENING_MARGIN = 0.008
"""The gripper opens by this much more than a box is wide, in metres: 4 mm on each side."""
ABOVE_CENTER = 0.012
"""The tool centre point is this far above the box's centre, in metres: the palm then clears neighbours of the same
height."""
PALM_GAP = 0.005
"""The palm stays this far above a tall box, in metres: it is then taken higher up."""


@dataclass(frozen=True, eq=False)
class Grasp:
    """One way to take a box."""

    tool: NDArray[np.float64]
    """(4, 4): pose of the tool frame in the world."""
    width: float
    """Distance between the two faces that are gripped, in metres."""


def top_grasps(center: NDArray[np.float64], standing: Stance, gripper: ParallelGripper) -> tuple[Grasp, ...]:
    """All grasps from above, the closer pair of faces first, and each with the hand either way round.

    Args:
        center: World position of the box's centre, (3,).
        standing: How the box stands.
        gripper: What takes it.

    Returns:
        The grasps; none if the box is too wide for the gripper both ways.
    """
    widths = standing.extent[:2]
    pairs = sorted((0, 1), key=lambda side: widths[side])
    if widths[pairs[0]] < widths[pairs[1]]:
        pairs = pairs[:1]
    position = center + np.array((0.0, 0.0, _above_center(standing.extent[2], gripper)))
    return tuple(
        Grasp(_tool_pose(position, standing.yaw + side * np.pi / 2 + turn, gripper), widths[side])
        for side in pairs
        if widths[side] + OPENING_MARGIN <= gripper.max_opening
        for turn in (0.0, np.pi)
    )


def _above_center(height: float, gripper: ParallelGripper) -> float:
    return max(min(ABOVE_CENTER, height / 4), height / 2 + PALM_GAP - gripper.palm_height)


def _tool_pose(position: NDArray[np.float64], closing: float, gripper: ParallelGripper) -> NDArray[np.float64]:
    """The tool pointing down, its fingers closing along the horizontal direction at this angle."""
    along = np.array([np.cos(closing), np.sin(closing), 0.0])
    down = np.array([0.0, 0.0, -1.0])
    own = np.array(gripper.closing_axis)
    z = np.array([0.0, 0.0, 1.0])
    world = np.column_stack([along, np.cross(down, along), down])
    tool = np.column_stack([own, np.cross(z, own), z])
    pose = np.eye(4)
    pose[:3, :3] = world @ tool.T
    pose[:3, 3] = position
    return pose


def held_width(size: tuple[float, float, float], grasp: NDArray[np.float64], gripper: ParallelGripper) -> float:
    """The distance between the gripped faces of a held box in metres; `grasp` (4, 4) is its pose in the tool frame."""
    side = int(np.argmax(np.abs(np.array(gripper.closing_axis) @ grasp[:3, :3])))
    return size[side]
