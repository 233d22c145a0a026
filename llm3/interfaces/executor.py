"""Something that moves."""

from __future__ import annotations

from abc import ABC, abstractmethod

import numpy as np

from llm3.types import Execution, PlannedAction, State


class Executor(ABC):
    """Carries out plans of one problem: on a robot, or on one that is simulated with its motors.

    Where things differ from the plan, it goes on as the plan says and tells what it saw: the goal is asked of where
    things really end. It is given no noise with the plan, since a real world brings its own: a domain whose executor
    simulates makes it with a :class:`~llm3.types.Noise`, one that drives a robot refuses any.
    """

    @abstractmethod
    def execute(self, start: State, actions: tuple[PlannedAction, ...], rng: np.random.Generator) -> Execution:
        """Carry a plan out.

        Args:
            start: The state in which the plan says that it begins.
            actions: The plan. Its actions are actions of the problem, and its configurations have the right number of
                joint values.
            rng: What chance decides, such as the noise of a simulated world: the same generator, the same execution.

        Raises:
            InputError: The plan makes no sense for the robot, such as outside of the limits of its joints; nothing
                has moved then.
        """

    def close(self) -> None:  # most have nothing to let go of
        """Let go of whatever is connected. Calling it twice does no harm."""
