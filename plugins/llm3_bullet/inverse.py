"""Inverse kinematics: configurations that put the tool into a given pose.

A few starts whose tool poses are close already reach nearly every pose that can be reached. Where they do not, many
more follow, and only when all of those have failed is the pose called unreachable. Where the arm is certainly too
short, starts serve only to tell by how much.
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass, replace

import numpy as np
from numpy.typing import NDArray

from llm3_bullet.arm_length import ArmLength, Disc
from llm3_bullet.descent import BOLD, CAUTIOUS, POSITION_TOLERANCE, ROTATION_TOLERANCE, descend, within_tolerance
from llm3_bullet.kinematics import Kinematics
from llm3_bullet.starts import StartTable

Array = NDArray[np.float64]

_DISTINCT = 0.1  # radians


@dataclass(frozen=True, eq=False)
class IKResult:
    """What was found for one target."""

    solutions: Array
    """(K, dof): configurations within the joint limits that reach the target, any two 0.1 rad or more apart."""
    closest: Array
    """(dof,): the configuration of the best attempt."""
    position_error: float
    """How far the tool is from the target in the best attempt, in metres: the shortfall of an unreachable target."""
    rotation_error: float
    """By which angle it is turned from the target there, in radians. A metre and a radian weigh the same."""
    starts: int
    """How many attempts were made."""

    @property
    def reached(self) -> bool:
        """Whether there is a solution."""
        return len(self.solutions) > 0


@dataclass(frozen=True)
class _Round:
    """Starts, and how they are followed."""

    neighbours: slice
    """Which entries of the table, the closest to the target first."""
    random: int
    """How many random ones besides."""
    steps: int
    damping: float


_FEW = _Round(slice(0, 8), random=0, steps=9, damping=BOLD)
_MANY = _Round(slice(8, 72), random=32, steps=40, damping=CAUTIOUS)
_CLOSEST = _Round(slice(0, 24), random=0, steps=25, damping=CAUTIOUS)


class InverseKinematics:
    """Finds configurations for tool poses by damped least squares from many starts."""

    def __init__(self, kinematics: Kinematics) -> None:
        self._kinematics = kinematics
        self._table = StartTable(kinematics)
        self._length = ArmLength(kinematics)

    def solve(self, target: Array, rng: np.random.Generator, near: Array | None = None) -> IKResult:
        """Find configurations that put the tool into a pose.

        Args:
            target: World pose of the tool, (4, 4).
            rng: Draws some of the further starts where the first ones fail.
            near: A configuration (dof,) from which to start as well; solutions come by their distance to it, the
                closest first.
        """
        return self.solve_many(target[None], rng, near)[0]

    def solve_many(self, targets: Array, rng: np.random.Generator, near: Array | None = None) -> tuple[IKResult, ...]:
        """`solve` for several targets (B, 4, 4) at once, which costs less than one after another."""
        too_far = self.too_far(targets)
        results: dict[int, IKResult] = {}
        for attempt, among in ((_FEW, ~too_far), (_MANY, ~too_far), (_CLOSEST, too_far)):
            open_ = [b for b in np.flatnonzero(among).tolist() if b not in results or not results[b].reached]
            if open_:
                found = self._attempt(targets[open_], self._starts(targets[open_], attempt, rng, near), attempt, near)
                results.update({b: _better(results.get(b), r) for b, r in zip(open_, found, strict=True)})
        return tuple(results[b] for b in range(len(targets)))

    def too_far(self, targets: Array) -> NDArray[np.bool_]:
        """For which targets (B, 4, 4) the arm is certainly too short, (B,); the others may be out of reach as well."""
        return self._length.too_short(targets, POSITION_TOLERANCE, ROTATION_TOLERANCE)

    @property
    def disc(self) -> Disc:
        """The tool certainly never leaves it, seen from above, while it points straight down."""
        return self._length.disc

    @property
    def highest(self) -> float:
        """The tool is certainly never higher than this while it points straight down, in metres."""
        return self._length.highest

    def _starts(self, targets: Array, attempt: _Round, rng: np.random.Generator, near: Array | None) -> Array:
        """Configurations to start from, (B, S, dof)."""
        model, count = self._kinematics.model, len(targets)
        starts = [self._table.nearest(targets, attempt.neighbours.stop)[:, attempt.neighbours]]
        if near is not None:
            starts.append(np.broadcast_to(near, (count, 1, model.dof)))
        if attempt.random:
            starts.append(rng.uniform(model.low, model.high, (count, attempt.random, model.dof)))
        return np.concatenate(starts, axis=1)

    def _attempt(self, targets: Array, starts: Array, attempt: _Round, near: Array | None) -> Iterator[IKResult]:
        """Follow all starts (B, S, dof) at once."""
        count = starts.shape[1]
        Q, errors = descend(
            self._kinematics,
            starts.reshape(-1, starts.shape[2]),
            np.repeat(targets, count, axis=0),
            attempt.steps,
            attempt.damping,
        )
        for q, error in zip(Q.reshape(starts.shape), errors.reshape(-1, count, 2), strict=True):
            yield _result(q, error, near)


def _result(Q: Array, errors: Array, near: Array | None) -> IKResult:
    met = within_tolerance(errors)
    best = int(np.where(met, 0.0, (errors**2).sum(axis=1)).argmin())
    solutions = Q[met]
    if near is not None:
        solutions = solutions[np.argsort(np.linalg.norm(solutions - near, axis=1), kind="stable")]
    position, rotation = map(float, errors[best])
    return IKResult(_distinct(solutions), Q[best], position, rotation, starts=len(Q))


def _distinct(Q: Array) -> Array:
    """The configurations without those that resemble an earlier one."""
    apart = np.linalg.norm(Q[:, None] - Q, axis=2) >= _DISTINCT
    kept: list[int] = []
    for k in range(len(Q)):
        if apart[k, kept].all():
            kept.append(k)
    return Q[np.array(kept, dtype=np.intp)]


def _better(first: IKResult | None, second: IKResult) -> IKResult:
    if first is None:
        return second
    best = min(second, first, key=lambda r: (not r.reached, np.hypot(r.position_error, r.rotation_error)))
    return replace(best, starts=first.starts + second.starts)
