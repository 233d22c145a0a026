"""What a run hands back."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Literal

from llm3.types.actions import Action
from llm3.types.attempts import Attempt
from llm3.types.motion import Motion
from llm3.types.state import GoalStatus, State
from llm3.types.stats import Stats


@dataclass(frozen=True)
class PlannedAction:
    """An action with the motion that carries it out and the state that it leads to."""

    action: Action
    motion: Motion
    state: State


Stop = Literal["solved", "calls", "tokens", "motions", "seconds", "attempts", "exhausted"]
"""Why a run ends: the goal is reached, or which part of the budget is used up.

A search also ends after very many attempts for its budget of motion calls, and when nothing is left to be tried."""


@dataclass(frozen=True)
class Result:
    """The outcome of a run."""

    solved: bool
    plan: tuple[PlannedAction, ...]
    """The solution; empty when the run is not solved."""
    goal: GoalStatus
    """Where the last attempt led."""
    attempts: tuple[Attempt, ...]
    stats: Stats
    start: State
    stop: Stop
    """Why it ended."""

    @property
    def time_limited(self) -> bool:
        """Whether a wall-clock guard cut something off, so that a second run may differ."""
        return self.stats.time_limited > 0
