"""The same motion at evenly spaced times."""

from __future__ import annotations

from dataclasses import replace
from math import ceil

import numpy as np

from llm3.errors import UsageError
from llm3.export.curves import Array, cubics, quintics
from llm3.export.limits import Limits
from llm3.export.program import TIME_DECIMALS, Move, Program
from llm3.interfaces import Joint
from llm3.types import Trajectory

ASIDE = 0.0005
"""How far a joint may be from the straight lines between the points, in its unit: as far as timers may leave a path."""
LOOKS = np.linspace(0.0, 1.0, 17)
"""Where between two points that is looked at."""
PACE = 1.01
"""By which factor a motion that is too fast becomes slower at a time, at least."""
SLOWEST = 4.0
"""Times as long a motion may take: what a joint does at the very end of its travel may not be cured by being slow."""


def resampled(program: Program, rate: float, joints: tuple[Joint, ...]) -> Program:
    """The program with points at even times, as many a second as the rate says.

    A polynomial between two such points is not quite that of the plan, where its acceleration jumps. So each motion is
    slowed down as a whole until both those who follow cubics and those who are given the accelerations as well, and
    follow quintics, keep the limits: by a sixth or so where a motion is as fast as it can be. A motion takes a whole
    number of periods.

    Args:
        program: What is to be done.
        rate: Points a second, more than 0.
        joints: What the robot can do, in the order of the program's joints.

    Raises:
        UsageError: With so few points a motion would leave the way that was planned, or the limits.
    """
    limits = Limits.of(joints)

    def evenly(move: Move) -> Move:
        if move.trajectory.duration == 0:
            return move
        slower = _slower(move, rate, limits)
        stray = _stray(slower, move.trajectory)
        joint = int(stray.argmax())
        if stray[joint] > ASIDE:
            raise UsageError(
                f"{rate:g} points a second are too few: in action {move.action} {move.text}, {move.segment}, "
                f"{joints[joint].name} would be {stray[joint]:.4f} {joints[joint].unit} off the way that was planned, "
                f"and {ASIDE} {joints[joint].unit} are allowed. Give a higher --rate, or none."
            )
        return replace(move, trajectory=slower)

    return replace(program, items=tuple(evenly(item) if isinstance(item, Move) else item for item in program.items))


def _slower(move: Move, rate: float, limits: Limits) -> Trajectory:
    """The fastest of some that take a whole number of periods and keep the limits."""
    planned = move.trajectory
    periods = fewest = max(1, ceil(planned.duration * rate - 1e-9))
    while periods <= SLOWEST * fewest + 10:
        made = _sampled(planned, periods, rate)
        if limits.keep(made):
            return made
        periods = ceil(max(periods + 1, periods * PACE))
    raise UsageError(
        f"with {rate:g} points a second, action {move.action} {move.text}, {move.segment}, cannot keep the limits: "
        "give another --rate, or none."
    )


def _sampled(planned: Trajectory, periods: int, rate: float) -> Trajectory:
    slower = periods / (rate * planned.duration)
    positions, velocities, _ = planned.sample(np.linspace(0.0, planned.duration, periods + 1))
    positions[[0, -1]] = planned.positions[0], planned.positions[-1]  # to the last digit
    velocities[[0, -1]] = planned.velocities[0], planned.velocities[-1]
    return Trajectory(
        tuple(round(number / rate, TIME_DECIMALS) for number in range(periods + 1)),
        tuple(map(tuple, positions.tolist())),
        tuple(map(tuple, (velocities / slower).tolist())),
    )


def _stray(made: Trajectory, planned: Trajectory) -> Array:
    """How far each joint gets from the straight lines between the points, at most, (dof,): as made, and as planned."""
    points = np.array(made.positions)
    a, b = points[:-1], points[1:]
    times = np.linspace(0.0, planned.duration, len(points))
    between = times[:-1] + LOOKS[:, None] * np.diff(times)
    way = planned.sample(between.ravel())[0].reshape(*between.shape, -1)
    found = np.array(
        [_off(seen, a, b) for seen in (way, cubics(made).positions(LOOKS), quintics(made).positions(LOOKS))]
    )
    return np.asarray(found.max(axis=0))


def _off(seen: Array, a: Array, b: Array) -> Array:
    """How far what is seen (K, N, dof) is from the straight lines from a to b, (N, dof), by joint: (dof,)."""
    way = b - a
    length = (way**2).sum(axis=1)
    along = ((seen - a) * way).sum(axis=2) / np.where(length > 0, length, 1.0)
    nearest = a + np.clip(along, 0.0, 1.0)[..., None] * way
    return np.asarray(np.abs(seen - nearest).max(axis=(0, 1)))
