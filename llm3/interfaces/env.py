"""The world, as the solver sees it."""

from __future__ import annotations

from abc import ABC, abstractmethod
from dataclasses import dataclass
from math import inf

import numpy as np

from llm3.types import (
    Action,
    ActionSchema,
    Entity,
    Failure,
    GoalStatus,
    Motion,
    MotionProblem,
    NoMotion,
    State,
    Transition,
)


@dataclass(frozen=True)
class Joint:
    """A joint of the robot, in the order of `State.configuration`."""

    name: str
    unit: str = "rad"
    max_velocity: float | None = None
    """The fastest that it may move either way, in its unit per second; None if that is not known."""
    max_acceleration: float | None = None
    """The hardest that it may accelerate or brake, in its unit per second squared; None if that is not known."""
    min_position: float | None = None
    """The one end of its travel, in its unit; None if it is not known, or there is none."""
    max_position: float | None = None
    """The other end; known if the first one is."""

    def __post_init__(self) -> None:
        low, high = self.min_position, self.max_position
        if (low is None) != (high is None) or (low is not None and high is not None and not -inf < low < high < inf):
            raise ValueError(
                f"joint {self.name!r}: the min position and the max position must be two numbers, the first one less, "
                f"or both null, not {low} and {high}"
            )
        for name in ("max_velocity", "max_acceleration"):
            value = getattr(self, name)
            if value is not None and not 0 < value < inf:
                what = name.replace("_", " ")
                raise ValueError(f"joint {self.name!r}: the {what} must be more than 0, not {value:g}")


class Env(ABC):
    """A planning problem: objects, actions, a transition function and a goal.

    Every method depends on its arguments alone. Two calls with equal arguments give equal answers, whatever was
    called in between; a simulator behind an Env is a cache, set from the State before each use.
    """

    @property
    @abstractmethod
    def task(self) -> str:
        """What the model must know of the world, the robot and the goal, as prose.

        The actions and the objects are not part of it: they are written from `schemas` and `describe`.
        """

    @property
    @abstractmethod
    def schemas(self) -> tuple[ActionSchema, ...]:
        """The primitive actions."""

    @property
    @abstractmethod
    def objects(self) -> tuple[str, ...]:
        """The names that actions may take as objects."""

    @property
    def joints(self) -> tuple[Joint, ...]:
        """The robot's joints, for plans on disk."""
        return ()

    @abstractmethod
    def reset(self) -> State:
        """The initial state."""

    @abstractmethod
    def describe(self, state: State) -> tuple[Entity, ...]:
        """The state as the model reads it: one entity for each thing that matters, numbers rounded."""

    @abstractmethod
    def prepare(self, state: State, action: Action, rng: np.random.Generator) -> MotionProblem | NoMotion | Failure:
        """What motion the action needs in this state.

        Args:
            state: Where the action begins.
            action: An action that fits its schema.
            rng: The only source of randomness, such as for the starts of inverse kinematics.

        Returns:
            A free-space query with goals whose straight pieces are checked; `NoMotion` where nothing moves; or why
            the action is impossible: `PRECONDITION`, `UNREACHABLE`, `GOAL_IN_COLLISION` or `START_IN_COLLISION`.
        """

    @abstractmethod
    def apply(self, state: State, action: Action, motion: Motion) -> Transition:
        """The state after the action was carried out by this motion (empty for `NoMotion`)."""

    @abstractmethod
    def goal(self, state: State) -> GoalStatus:
        """Whether the goal is reached and, if not, what is missing."""

    def close(self) -> None:
        """Let go of whatever stands behind the Env. Calling it twice does no harm."""
