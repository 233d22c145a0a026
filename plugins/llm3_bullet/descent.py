"""Steps of damped least squares towards tool poses, for many configurations at once.

The step minimises |J Δq - e|² + λ |Δq|² with λ proportional to |e|², so that it is cautious far from the target
and turns into Newton's step close to it, and is defined where the target cannot be reached: T. Sugihara,
"Solvability-Unconcerned Inverse Kinematics by the Levenberg-Marquardt Method", IEEE Transactions on Robotics
27(5), 2011. Joint limits are kept by projection: a joint that stands at a limit and would be pushed beyond it
takes no part in the step (D. P. Bertsekas, "Projected Newton Methods for Optimization Problems with Simple
Constraints", SIAM Journal on Control and Optimization 20(2), 1982).

Errors weigh a radian like a metre.
"""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from llm3_bullet.kinematics import Kinematics

Array = NDArray[np.float64]

POSITION_TOLERANCE = 1e-5
"""A target counts as met when the tool is at most this far from it, in metres,"""
ROTATION_TOLERANCE = 1e-4
"""and turned from it by at most this angle, in radians."""

BOLD = 0.05
"""λ for |e|² = 1: quick where the target can be reached."""
CAUTIOUS = 0.5
"""λ for |e|² = 1: settles at the smallest error where it cannot."""

_PATIENCE, _PROGRESS = 4, 0.8  # given up unless |e|² falls to this part of itself within so many steps
_NEARLY = 1e-6  # |e|² from which on no attempt is given up: the last millimetre is bumpy where the arm is stretched out
_LEAST_DAMPING = 1e-9  # keeps the equations solvable where the arm is singular


def pose_error(poses: Array, targets: Array) -> Array:
    """What separates poses from targets, both (N, 4, 4): (N, 6).

    The first three are the way to go in metres, the last three the rotation vector to turn by in radians, both in the
    world frame. A rotation's length is its angle, 0 to π.
    """
    error = np.empty((len(poses), 6))
    error[:, :3] = targets[:, :3, 3] - poses[:, :3, 3]
    turn = targets[:, :3, :3] @ poses[:, :3, :3].swapaxes(1, 2)
    sine_axis = np.stack(
        [turn[:, 2, 1] - turn[:, 1, 2], turn[:, 0, 2] - turn[:, 2, 0], turn[:, 1, 0] - turn[:, 0, 1]], axis=1
    )
    sine = np.sqrt((sine_axis**2).sum(axis=1))
    angle = np.arctan2(sine, turn[:, 0, 0] + turn[:, 1, 1] + turn[:, 2, 2] - 1.0)
    lost = sine < 1e-9  # no axis can be read from a turn by 0 or by π, and for the latter any will do
    sine_axis[lost], sine[lost] = (0.0, 0.0, 1.0), 1.0
    error[:, 3:] = sine_axis * (angle / sine)[:, None]
    return error


def magnitudes(error: Array) -> Array:
    """Distances in metres and angles in radians, (N, 2), of errors (N, 6)."""
    lengths: Array = np.sqrt((error.reshape(-1, 2, 3) ** 2).sum(axis=2))
    return lengths


def within_tolerance(errors: Array) -> NDArray[np.bool_]:
    """Which `magnitudes` (N, 2) are small enough: (N,)."""
    return np.asarray((errors <= (POSITION_TOLERANCE, ROTATION_TOLERANCE)).all(axis=1))


def damped_step(kinematics: Kinematics, Q: Array, targets: Array, damping: float = BOLD) -> tuple[Array, Array]:
    """One step of each configuration (N, dof) towards its target (N, 4, 4), within the joint limits.

    Returns:
        The new configurations (N, dof), and the errors (N, 6) of the old ones.
    """
    model = kinematics.model
    poses, jacobian = kinematics.tool_and_jacobian(Q)
    error = pose_error(poses, targets)
    pull = (error[:, None] @ jacobian)[:, 0]
    stuck = ((model.low >= Q) & (pull < 0)) | ((model.high <= Q) & (pull > 0))
    jacobian *= ~stuck[:, None]
    transposed = jacobian.swapaxes(1, 2)
    square = jacobian @ transposed
    added = damping * (error**2).sum(axis=1) + _LEAST_DAMPING
    square.reshape(-1, 36)[:, ::7] += added[:, None]  # the diagonals
    step = (transposed @ np.linalg.solve(square, error[:, :, None]))[:, :, 0]
    return np.clip(Q + step, model.low, model.high), error


def descend(kinematics: Kinematics, Q: Array, targets: Array, steps: int, damping: float = BOLD) -> tuple[Array, Array]:
    """Step each configuration (N, dof) until it meets its target (N, 4, 4) or gets no closer, or for so many steps.

    Returns:
        The closest configuration (N, dof) on the way of each, within the joint limits, and the `magnitudes` (N, 2) of
        its error.
    """
    Q = np.clip(Q, kinematics.model.low, kinematics.model.high)
    live, every = np.arange(len(Q)), np.arange(len(Q))
    way = np.empty((steps, *Q.shape))
    errors = np.empty((steps, len(Q), 2))
    sizes = np.full((steps, len(Q)), np.inf)  # |e|²
    for step in range(steps):
        way[step] = Q
        stepped, error = damped_step(kinematics, Q[live], targets[live], damping)
        lengths = magnitudes(error)
        met = within_tolerance(lengths)
        size = np.where(met, 0.0, (lengths**2).sum(axis=1))
        errors[step, live], sizes[step, live] = lengths, size
        promising = ~met
        if step >= _PATIENCE:
            promising &= (size < _PROGRESS * sizes[step - _PATIENCE, live]) | (size < _NEARLY)
        live = live[promising]
        if not len(live):
            break
        Q[live] = stepped[promising]
    closest = sizes.argmin(axis=0)
    return way[closest, every], errors[closest, every]
