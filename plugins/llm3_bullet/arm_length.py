"""Tool poses for which an arm is certainly too short."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from llm3_bullet.kinematics import Kinematics

Array = NDArray[np.float64]

_SWEEPS = 20


@dataclass(frozen=True)
class Disc:
    """A disc in the world's x and y, in metres."""

    center: tuple[float, float]
    radius: float


class ArmLength:
    """A bound on how far the tool can be from the base.

    A point on the axis of a revolute joint belongs to both of the links that the joint connects. Choose one on every
    axis: the distance between two neighbours is the same in all configurations, and so the last point, which the tool
    pose tells, is never further from the first, which stands still, than all these distances together. A sliding joint
    adds its travel. Any choice gives a valid bound; here the points are moved until the way through them is short.
    """

    def __init__(self, kinematics: Kinematics) -> None:
        model = kinematics.model
        frames = kinematics.link_frames(model.low[None], opening=0.0)[0]  # a sliding joint is then at one of its ends
        joints = [frames[number + 1] for number in model.arm_joints]
        slides = np.array([model.joints[number].type == "prismatic" for number in model.arm_joints])
        axes = np.array([f[:3, :3] @ model.joints[n].axis for f, n in zip(joints, model.arm_joints, strict=True)])
        axes[slides] = 0.0  # the only point to choose there is the joint's origin
        points = _short_way(np.array([frame[:3, 3] for frame in joints]), axes)
        self._first = points[0]
        self._last = np.linalg.inv(frames[model.tool])[:3] @ np.append(points[-1], 1.0)  # in the tool frame
        travel = (model.high - model.low)[slides].sum()
        self._length = float(np.linalg.norm(np.diff(points, axis=0), axis=1).sum() + travel)
        self.highest = float(self._first[2] + self._length + self._last[2])
        """The tool is never higher than this while it points straight down, in metres."""
        self.disc = Disc(
            (float(self._first[0]), float(self._first[1])), self._length + float(np.linalg.norm(self._last[:2]))
        )
        """Which the tool never leaves, seen from above, while it points straight down."""

    def too_short(self, targets: Array, position_tolerance: float, rotation_tolerance: float) -> NDArray[np.bool_]:
        """For which tool poses (B, 4, 4) the arm is certainly too short: (B,). The others may be out of reach as well.

        Args:
            targets: In the world frame.
            position_tolerance: How far from a target the tool may end, in metres,
            rotation_tolerance: and how far turned from it, in radians.
        """
        last = targets[:, :3, :3] @ self._last + targets[:, :3, 3]
        tolerance = position_tolerance + rotation_tolerance * float(np.linalg.norm(self._last))
        return np.asarray(np.linalg.norm(last - self._first, axis=1) > self._length + tolerance)


def _short_way(origins: Array, axes: Array) -> Array:
    """A point on each axis, given by an origin and a unit vector, such that the way through them is short: (n, 3)."""
    points = origins.copy()
    for _ in range(_SWEEPS if len(points) > 1 else 0):
        for j, (origin, axis) in enumerate(zip(origins, axes, strict=True)):
            beside = np.array([points[k] for k in (j - 1, j + 1) if 0 <= k < len(points)]) - origin
            along = beside @ axis
            across = np.linalg.norm(beside - along[:, None] * axis, axis=1) + 1e-12
            # Light that goes from one neighbour to the other by a mirror touches it here: Heron of Alexandria.
            points[j] = origin + axis * np.average(along, weights=across[::-1])
    return points
