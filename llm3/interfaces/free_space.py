"""The free space of one motion problem: what a planner asks of it."""

from __future__ import annotations

from collections.abc import Sequence
from functools import lru_cache
from itertools import pairwise

import numpy as np
from numpy.typing import NDArray

from llm3.errors import PluginError
from llm3.types import Contact, Failure, FailureKind, Mask, MotionProblem, Vector

FIRST_BATCH = 16
"""Samples of a path that are tested first; each further batch is twice as long.

An obstacle of some width shows among so few, and large batches are cheap for what is free to its end.
"""


class FreeSpace:
    """Answers what is free at the problem's resolution, in batches, and counts what it tests."""

    def __init__(self, problem: MotionProblem) -> None:
        """Look at the free space of this problem.

        Raises:
            PluginError: The limits or the resolution are no ranges to search.
        """
        low, high, resolution = problem.low, problem.high, problem.resolution
        if not (np.isfinite(low).all() and np.isfinite(high).all() and (low <= high).all()):
            raise PluginError(
                f"joint limits must be finite and low <= high, not low={low.tolist()}, high={high.tolist()}."
            )
        if not (resolution > 0).all():
            raise PluginError(f"the resolution must be positive in every joint, not {resolution.tolist()}.")
        self._problem = problem
        self.checks = 0
        """Configurations tested so far."""

    def free(self, configurations: Vector) -> Mask:
        """Which of the configurations (N, dof) are free, shape (N,).

        Raises:
            PluginError: The problem's validity test does not answer one truth value a configuration.
        """
        self.checks += len(configurations)
        mask = np.asarray(self._problem.valid(configurations), dtype=bool)
        if mask.shape != (len(configurations),):
            raise PluginError(
                f"the validity test must answer {len(configurations)} configurations with shape "
                f"({len(configurations)},), not {mask.shape}."
            )
        return mask

    def uncertain(self, start: Vector, end: Vector, steps: int) -> Mask:
        """Which samples of the straight line, that many even steps apart, need a test, shape (steps + 1,).

        Raises:
            PluginError: The problem does not answer one truth value a sample.
        """
        if self._problem.uncertain is None or steps <= FIRST_BATCH:
            return np.ones(steps + 1, dtype=bool)
        mask = np.asarray(self._problem.uncertain(start, end, steps), dtype=bool)
        if mask.shape != (steps + 1,):
            raise PluginError(f"`uncertain` must answer {steps} steps with shape ({steps + 1},), not {mask.shape}.")
        return mask

    def free_goals(self) -> NDArray[np.int64] | Failure:
        """The numbers of the goals that are free, in order; or why there is nothing to search for.

        Returns:
            `START_IN_COLLISION` or `GOAL_IN_COLLISION`, see `collision`.
        """
        start, goals = self._problem.start, np.array([goal.configuration for goal in self._problem.goals])
        start_free, *goals_free = self.free(np.vstack([start, goals]))
        if not start_free:
            return self.collision(FailureKind.START_IN_COLLISION, start[None])
        if not any(goals_free):
            return self.collision(FailureKind.GOAL_IN_COLLISION, goals)
        return np.flatnonzero(goals_free)

    def path(self, waypoints: Vector) -> bool:
        """Whether the straight lines that join these waypoints (N, dof) are free, both ends of each included.

        The samples of a line are the same numbers in both directions, to the last bit.
        """
        lines = pairwise(waypoints)
        samples = np.vstack([waypoints[-1:], *(self._samples(start, end) for start, end in lines)])
        first, size = 0, FIRST_BATCH
        while first < len(samples):
            if not self.free(samples[first : first + size]).all():
                return False
            first, size = first + size, 2 * size
        return True

    def _samples(self, start: Vector, end: Vector) -> Vector:
        """What needs a test from `start` until shortly before `end`, so that an obstacle of some width is soon met."""
        steps = max(1, int(np.ceil((np.abs(end - start) / self._problem.resolution).sum())))
        numbers = np.concatenate([[0], bisection_order(steps)])
        i = numbers[self.uncertain(start, end, steps)[numbers]][:, None]
        return np.where(i == 0, start, (start * (steps - i) + end * i) / steps)

    def collision(self, kind: FailureKind, configurations: Vector) -> Failure:
        """Why none of these configurations, shape (N, dof), will do.

        Objects come in the order of how many of the configurations touch them, and then of depth. Contacts and
        configuration are those of the one that is nearest to being free, among those that touch the first object. The
        measures are ``configurations``, their number, and ``hit_share``, the share of them that touches the first
        object. The failure's stats are for the planner to fill in.
        """
        explained = [sorted(self._problem.explain(q), key=lambda contact: -contact.depth) for q in configurations]
        nearest = min(range(len(explained)), key=lambda i: _depth(explained[i]))
        in_order = dict.fromkeys(
            contact.object for contacts in [explained[nearest], *explained] for contact in contacts
        )
        hits = {name: sum(any(c.object == name for c in contacts) for contacts in explained) for name in in_order}
        objects = tuple(sorted(hits, key=lambda name: -hits[name]))
        touching = [i for i, contacts in enumerate(explained) if any(c.object in objects[:1] for c in contacts)]
        nearest = min(touching, key=lambda i: _depth(explained[i]), default=nearest)
        measures = {"configurations": float(len(explained))}
        if objects:
            measures["hit_share"] = hits[objects[0]] / len(explained)
        return Failure(
            kind,
            objects=objects,
            contacts=tuple(explained[nearest]),
            configuration=tuple(configurations[nearest].tolist()),
            measures=measures,
        )


@lru_cache(1024)
def bisection_order(steps: int) -> NDArray[np.int64]:
    """The numbers from 1 to ``steps - 1``, so that every beginning of them is spread over the whole range.

    They come in descending order of the largest power of two that divides them. Not to be written to.
    """
    strides = [1 << k for k in reversed(range(steps.bit_length()))]
    order = np.concatenate([np.arange(stride, steps, 2 * stride) for stride in strides])
    order.setflags(write=False)
    return order


def _depth(contacts: Sequence[Contact]) -> float:
    """How deep a configuration is in collision; one that cannot be explained counts as the deepest."""
    return max((contact.depth for contact in contacts), default=np.inf)
