"""The motion planner."""

from __future__ import annotations

from abc import ABC, abstractmethod
from collections.abc import Callable
from dataclasses import dataclass
from time import perf_counter

import numpy as np

from llm3.errors import UsageError
from llm3.types import Failure, MotionProblem, Path


@dataclass(frozen=True)
class PlannerSettings:
    """What a planner may spend on one query."""

    max_iterations: int = 2000
    """The budget, in iterations and not in seconds, so that a busy machine gives the same answer; 0 is no search."""
    max_seconds: float = 30.0
    """A guard against the unforeseen; a query that it cuts off is marked `time_limited`."""
    clock: Callable[[], float] = perf_counter

    def __post_init__(self) -> None:
        if self.max_iterations < 0:
            raise UsageError(f"the planner's iterations must be 0 or more, not {self.max_iterations}.")
        if not self.max_seconds > 0:
            raise UsageError(f"the planner's seconds must be more than 0, not {self.max_seconds:g}.")


class MotionPlanner(ABC):
    """Searches a path through free space."""

    @abstractmethod
    def plan(self, problem: MotionProblem, rng: np.random.Generator) -> Path | Failure:
        """Find a path from the problem's start to any of its goals.

        Args:
            problem: The query. Goals come in order of preference.
            rng: The only source of randomness: the same generator state gives the same path.

        Returns:
            A path that is valid at the problem's resolution, or a Failure: `START_IN_COLLISION`,
            `GOAL_IN_COLLISION` when every goal is, or `NO_PATH` when the budget ends.
        """
