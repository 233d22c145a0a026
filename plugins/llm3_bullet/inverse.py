"""Inverse kinematics: configurations that put the tool into a given pose."""

from __future__ import annotations

from dataclasses import dataclass, replace

import numpy as np
from numpy.typing import NDArray

from llm3_bullet.descent import BOLD, CAUTIOUS, descend, within_tolerance
from llm3_bullet.kinematics import Kinematics
from llm3_bullet.starts import StartTable

Array = NDArray[np.float64]

_FEW, _FEW_STEPS = 8, 9  # enough for nearly every pose that can be reached
_MANY, _RANDOM, _MANY_STEPS = 64, 32, 25  # spent before a pose is called unreachable
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


class InverseKinematics:
    """Finds configurations for tool poses by damped least squares from many starts."""

    def __init__(self, kinematics: Kinematics) -> None:
        self._kinematics = kinematics
        self._table = StartTable(kinematics)

    def solve(self, target: Array, rng: np.random.Generator, near: Array | None = None) -> IKResult:
        """Find configurations that put the tool into a pose.

        Args:
            target: World pose of the tool, (4, 4).
            rng: Draws further starts where the first ones fail; a pose is called unreachable only after those.
            near: A configuration (dof,) from which to start as well; solutions come by their distance to it, the
                closest first.
        """
        return self.solve_many(target[None], rng, near)[0]

    def solve_many(self, targets: Array, rng: np.random.Generator, near: Array | None = None) -> tuple[IKResult, ...]:
        """`solve` for several targets (B, 4, 4) at once, which costs less than one after another."""
        model = self._kinematics.model
        starts = self._table.nearest(targets, _FEW)
        if near is not None:
            starts = np.concatenate([np.broadcast_to(near, (len(targets), 1, model.dof)), starts], axis=1)
        results = self._attempt(targets, starts, _FEW_STEPS, BOLD, near)
        failed = [b for b, result in enumerate(results) if not result.reached]
        if failed:
            table = self._table.nearest(targets[failed], _FEW + _MANY)[:, _FEW:]
            random = rng.uniform(model.low, model.high, (len(failed), _RANDOM, model.dof))
            more = self._attempt(targets[failed], np.concatenate([table, random], axis=1), _MANY_STEPS, CAUTIOUS, near)
            for b, result in zip(failed, more, strict=True):
                results[b] = _better(results[b], result)
        return tuple(results)

    def _attempt(self, targets: Array, starts: Array, steps: int, damping: float, near: Array | None) -> list[IKResult]:
        """Descend from the starts (B, S, dof) of each target."""
        count = starts.shape[1]
        Q, errors = descend(
            self._kinematics, starts.reshape(-1, starts.shape[2]), np.repeat(targets, count, axis=0), steps, damping
        )
        return [
            _result(q, error, near)
            for q, error in zip(Q.reshape(starts.shape), errors.reshape(-1, count, 2), strict=True)
        ]


def _result(Q: Array, errors: Array, near: Array | None) -> IKResult:
    best = int((errors**2).sum(axis=1).argmin())
    solutions = Q[within_tolerance(errors)]
    if near is not None:
        solutions = solutions[np.argsort(np.linalg.norm(solutions - near, axis=1), kind="stable")]
    position, rotation = map(float, errors[best])
    return IKResult(_distinct(solutions), Q[best], position, rotation, starts=len(Q))


def _distinct(Q: Array) -> Array:
    """The configurations without those that resemble an earlier one."""
    kept = np.empty((0, Q.shape[1]))
    for q in Q:
        if (np.linalg.norm(kept - q, axis=1) >= _DISTINCT).all():
            kept = np.vstack([kept, q])
    return kept


def _better(first: IKResult, second: IKResult) -> IKResult:
    best = min(second, first, key=lambda r: (not r.reached, np.hypot(r.position_error, r.rotation_error)))
    return replace(best, starts=first.starts + second.starts)
