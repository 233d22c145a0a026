"""The free space of one problem: its validity test, asked for edges and counted."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from llm3.errors import PluginError
from llm3.types import Mask, MotionProblem, Vector

FIRST_BATCH = 256
"""Samples in an edge's first batch; each further batch is twice as long.

A vectorised validity test is so much cheaper per sample in a large batch that stopping earlier does not pay.
"""


def bisection_order(steps: int) -> NDArray[np.int64]:
    """The numbers from 1 to ``steps - 1``, so that every beginning of them is spread over the whole range.

    They come in descending order of the largest power of two that divides them: an obstacle of some width is met
    early, wherever on the edge it lies.
    """
    strides = [1 << k for k in reversed(range(steps.bit_length()))]
    return np.concatenate([np.arange(stride, steps, 2 * stride) for stride in strides])


class FreeSpace:
    """Answers whether configurations and straight edges are free."""

    def __init__(self, problem: MotionProblem) -> None:
        """Look at the free space of this problem.

        Raises:
            PluginError: The limits or the resolution are no ranges to sample from.
        """
        low, high, resolution = problem.low, problem.high, problem.resolution
        if not (np.isfinite(low).all() and np.isfinite(high).all() and (low <= high).all()):
            raise PluginError(
                f"joint limits must be finite and low <= high, not low={low.tolist()}, high={high.tolist()}."
            )
        if not (resolution > 0).all():
            raise PluginError(f"the resolution must be positive in every joint, not {resolution.tolist()}.")
        self.low, self.high = low, high
        self._resolution = resolution
        self._valid = problem.valid
        self.checks = 0
        """Configurations tested so far."""

    def free(self, configurations: Vector) -> Mask:
        """Which of the configurations (N, dof) are free, shape (N,).

        Raises:
            PluginError: The problem's validity test does not answer one truth value a configuration.
        """
        self.checks += len(configurations)
        mask = np.asarray(self._valid(configurations), dtype=bool)
        if mask.shape != (len(configurations),):
            raise PluginError(
                f"the validity test must answer {len(configurations)} configurations with shape "
                f"({len(configurations)},), not {mask.shape}."
            )
        return mask

    def edge(self, start: Vector, end: Vector) -> bool:
        """Whether the straight line from `start` to `end` is free at the problem's resolution.

        `start` itself is taken as known to be free; `end` is tested. The samples between them are the same numbers
        in both directions, to the last bit, so that an edge found by a tree of goals holds as part of the path.
        """
        steps = max(1, int(np.ceil((np.abs(end - start) / self._resolution).sum())))
        order = bisection_order(steps)
        first, size = 0, FIRST_BATCH
        while first == 0 or first < len(order):
            i = order[first : first + size, None]
            samples = (start * (steps - i) + end * i) / steps
            if first == 0:
                samples = np.vstack([end, samples])
            if not self.free(samples).all():
                return False
            first, size = first + size, 2 * size
        return True

    def step(self, start: Vector, target: Vector, length: float) -> Vector:
        """The point at most `length` from `start` on the way to `target`; `target` itself where it is that near."""
        distance = float(np.linalg.norm(target - start))
        if distance <= length:
            return target
        return np.clip(start + (target - start) * (length / distance), self.low, self.high)

    def sample(self, rng: np.random.Generator) -> Vector:
        """A configuration within the limits, uniformly."""
        return rng.uniform(self.low, self.high)
