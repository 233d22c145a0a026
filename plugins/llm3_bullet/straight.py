"""Joint motions along which the tool follows a straight line: approach, lift and retreat."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from llm3_bullet.descent import descend, within_tolerance
from llm3_bullet.kinematics import Kinematics

Array = NDArray[np.float64]

MAX_DEVIATION = 5e-4
"""Halfway between two waypoints the tool is at most this far from the line, in metres."""
MAX_JUMP = 0.3
"""Between two waypoints no joint moves further than this, in radians."""
_END_STEPS, _STEPS = 8, 5


def line_poses(start: Array, end: Array, spacing: float) -> Array:
    """Poses evenly spaced on the line from one pose to another, both (4, 4), turned like the end: (M, 4, 4).

    The first one is a step away from the start, the last one is the end, and two are at most `spacing` metres apart.
    """
    way = end[:3, 3] - start[:3, 3]
    count = max(1, int(np.ceil(np.linalg.norm(way) / spacing - 1e-9)))
    poses = np.repeat(end[None], count, axis=0)
    poses[:, :3, 3] = start[:3, 3] + np.linspace(0.0, 1.0, count + 1)[1:, None] * way
    return poses


def straight_line(kinematics: Kinematics, starts: Array, targets: Array) -> tuple[Array, NDArray[np.bool_]]:
    """Follow tool poses from each of several start configurations.

    The line's end is found from its start by damped least squares, which moves the joints as little as it can; the
    waypoints between them are then corrected from straight interpolation in joint space, all at once.

    Args:
        kinematics: The robot's.
        starts: Configurations, (K, dof), that stand where the line begins.
        targets: World poses of the tool along the line, (M, 4, 4), evenly spaced by some 10 mm; the start's own pose
            is not among them.

    Returns:
        The waypoints, (K, M, dof), within the joint limits, and which lines can be followed, (K,): those where the
        tool meets every pose within `POSITION_TOLERANCE` and `ROTATION_TOLERANCE`, no joint jumps by more than
        `MAX_JUMP`, and straight interpolation in joint space stays within `MAX_DEVIATION` of the line. The waypoints
        of the other lines mean nothing.
    """
    (count, dof), length = starts.shape, len(targets)
    ends, errors = descend(kinematics, starts, np.broadcast_to(targets[-1], (count, 4, 4)), _END_STEPS)
    fractions = np.arange(1, length + 1)[:, None] / length
    waypoints = starts[:, None] + fractions * (ends - starts)[:, None]
    followed = within_tolerance(errors)
    live = np.flatnonzero(followed)
    corrected, errors = descend(
        kinematics, waypoints[live].reshape(-1, dof), np.tile(targets, (len(live), 1, 1)), _STEPS
    )
    waypoints[live] = corrected.reshape(-1, length, dof)
    followed[live] = within_tolerance(errors).reshape(-1, length).all(axis=1)
    whole = np.concatenate([starts[:, None], waypoints], axis=1)
    smooth = np.abs(np.diff(whole, axis=1)).max(axis=(1, 2)) <= MAX_JUMP
    return waypoints, followed & smooth & (_deviation(kinematics, whole) <= MAX_DEVIATION)


def _deviation(kinematics: Kinematics, waypoints: Array) -> Array:
    """How far the tool strays from the straight line halfway between waypoints, at most: (K,), in metres."""
    halfway = (waypoints[:, 1:] + waypoints[:, :-1]) / 2
    count, pieces, dof = halfway.shape
    both = np.concatenate([waypoints, halfway], axis=1).reshape(-1, dof)
    tool = kinematics.tool(both)[:, :3, 3].reshape(count, 2 * pieces + 1, 3)
    met, between = tool[:, : pieces + 1], tool[:, pieces + 1 :]
    stray = np.linalg.norm(between - (met[:, 1:] + met[:, :-1]) / 2, axis=2)
    return np.asarray(stray.max(axis=1))
