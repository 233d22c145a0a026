"""Joint motions along which the tool follows a straight line: approach, lift and retreat."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from llm3_bullet.descent import descend, pose_error, within_tolerance
from llm3_bullet.kinematics import Kinematics

Array = NDArray[np.float64]

MAX_DEVIATION = 5e-4
"""Halfway between two waypoints the tool is at most this far from the line, in metres."""
MAX_JUMP = 0.3
"""Between two waypoints no joint moves further than this, in radians."""
_END_STEPS, _STEPS = 8, 6
_SINGULAR = 0.05  # singular values below this fraction of the largest count as none: no guess goes far for them


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

    The waypoints are guessed on a straight line in joint space and then corrected by damped least squares, all at once.
    The guess ends where the start's Jacobian points to; where that leads nowhere, where damped least squares leads.

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
    waypoints = np.empty((len(starts), len(targets), starts.shape[1]))
    followed = np.zeros(len(starts), dtype=bool)
    for ends in (_ends_by_jacobian, _ends_by_descent):
        open_ = np.flatnonzero(~followed)
        if len(open_):
            guessed = ends(kinematics, starts[open_], targets[-1])
            waypoints[open_], followed[open_] = _corrected(kinematics, starts[open_], guessed, targets)
    return waypoints, followed


def _ends_by_jacobian(kinematics: Kinematics, starts: Array, target: Array) -> Array:
    """The least motion of the joints, (K, dof), that to first order takes the tool to the target."""
    poses, jacobian = kinematics.tool_and_jacobian(starts)
    along = pose_error(poses, np.broadcast_to(target, (len(starts), 4, 4)))
    inverse = np.linalg.pinv(jacobian, rcond=_SINGULAR)
    ends: Array = starts + (inverse @ along[:, :, None])[:, :, 0]
    return ends


def _ends_by_descent(kinematics: Kinematics, starts: Array, target: Array) -> Array:
    return descend(kinematics, starts, np.broadcast_to(target, (len(starts), 4, 4)), _END_STEPS)[0]


def _corrected(kinematics: Kinematics, starts: Array, ends: Array, targets: Array) -> tuple[Array, NDArray[np.bool_]]:
    """Waypoints between starts and guessed ends, both (K, dof), moved onto the targets; and which lines are good."""
    (count, dof), length = starts.shape, len(targets)
    fractions = np.arange(1, length + 1)[:, None] / length
    guesses = starts[:, None] + fractions * (ends - starts)[:, None]
    corrected, errors = descend(kinematics, guesses.reshape(-1, dof), np.tile(targets, (count, 1, 1)), _STEPS)
    waypoints = corrected.reshape(count, length, dof)
    followed = within_tolerance(errors).reshape(count, length).all(axis=1)
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
