"""The joint space of one problem: what is free in it, asked in batches."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from llm3.interfaces import FreeSpace
from llm3.interfaces.free_space import bisection_order
from llm3.types import MotionProblem, Vector

FIRST_BATCH = 16
"""Samples of a straight line that are tested first.

An obstacle of some width shows among so few, and samples that touch something cost a validity test the most.
"""
GROWTH = 16
"""How much larger each further batch is: what is still free is probably free to its end."""
SLACK = 1e-9
"""How much longer than the resolution a step may be, as a fraction: so a part of a line keeps the line's samples."""


@dataclass(frozen=True, eq=False)
class Advance:
    """How far a straight line is free."""

    nodes: Vector
    """The ends of the strides that are free, shape (N, dof); the last is the line's end where all of it is free."""
    blocked: Vector | None
    """The first blocked sample, shape (dof,); None where the whole line is free."""


class JointSpace(FreeSpace):
    """Answers whether straight lines are free at the problem's resolution, and draws configurations.

    The start of a line is taken as known to be free. Its samples divide it evenly and are the same numbers in both
    directions. Where a line is cut at one of them, the samples of the parts are its own, to rounding: what is left of
    a free line needs no new test.
    """

    def __init__(self, problem: MotionProblem) -> None:
        """Look at the joint space of this problem.

        Raises:
            PluginError: The limits or the resolution are no ranges to sample from.
        """
        super().__init__(problem)
        self._low, self._high, self._resolution = problem.low, problem.high, problem.resolution

    def steps(self, start: Vector, end: Vector) -> int:
        """The number of even steps from `start` to `end` that neighbouring samples are apart."""
        length = float((np.abs(end - start) / self._resolution).sum())
        return max(1, int(np.ceil(length * (1 - SLACK))))

    def obstacle(self, start: Vector, end: Vector) -> Vector | None:
        """A blocked sample of the straight line from `start` to `end`, shape (dof,); None where all of it is free.

        The first batch that meets something ends the test.
        """
        steps = self.steps(start, end)
        for batch in self._batches(start, end, steps):
            samples = _samples(start, end, steps, batch)
            blocked = ~self.free(samples)
            if blocked.any():
                found: Vector = samples[int(blocked.argmax())]
                return found
        return None

    def advance(self, start: Vector, end: Vector, length: float) -> Advance:
        """Go from `start` towards `end`, by whole strides of about this length, for as long as it is free."""
        steps = self.steps(start, end)
        limit = steps + 1  # the first sample that is known to be blocked
        for batch in self._batches(start, end, steps):
            before = batch[batch < limit]
            if not len(before):
                continue
            blocked = before[~self.free(_samples(start, end, steps, before))]
            limit = min([limit, *blocked.tolist()])
        strides = min(steps, max(1, int(np.ceil(np.linalg.norm(end - start) / length))))
        numbers = np.arange(1, strides + 1) * steps // strides
        nodes = _samples(start, end, steps, numbers[numbers < limit])
        return Advance(nodes, None if limit > steps else _samples(start, end, steps, np.array([limit]))[0])

    def _batches(self, start: Vector, end: Vector, steps: int) -> Iterator[NDArray[np.int64]]:
        """The numbers of the line's samples from 1 to `steps` that need a test, the end first, in growing batches."""
        order = np.concatenate([[steps], bisection_order(steps)])
        order = order[self.uncertain(start, end, steps)[order]]
        first, size = 0, FIRST_BATCH
        while first < len(order):
            yield order[first : first + size]
            first, size = first + size, GROWTH * size

    def step(self, start: Vector, target: Vector, length: float) -> Vector:
        """The point at most `length` from `start` on the way to `target`; `target` itself where it is that near."""
        distance = float(np.linalg.norm(target - start))
        if distance <= length:
            return target
        return np.clip(start + (target - start) * (length / distance), self._low, self._high)

    def sample(self, rng: np.random.Generator) -> Vector:
        """A configuration within the limits, uniformly."""
        return rng.uniform(self._low, self._high)

    @property
    def diagonal(self) -> float:
        """The length of the diagonal of the joint limits."""
        return float(np.linalg.norm(self._high - self._low))


def _samples(start: Vector, end: Vector, steps: int, numbers: NDArray[np.int64]) -> Vector:
    """Samples (N, dof) of a line by their numbers; the ends are `start` and `end` themselves, to the last bit."""
    i = numbers[:, None]
    between = (start * (steps - i) + end * i) / steps
    return np.where(i == 0, start, np.where(i == steps, end, between))
