"""Proposals of the model and what became of them."""

from __future__ import annotations

from dataclasses import dataclass

from llm3.types.actions import Action
from llm3.types.failures import Failure
from llm3.types.state import GoalStatus


@dataclass(frozen=True)
class Rejected:
    """An item of a plan that is no valid action. It fails when the rollout reaches it."""

    text: str
    """What the model wrote, cut to a readable length."""
    failure: Failure

    def __str__(self) -> str:
        return self.text


@dataclass(frozen=True)
class Proposal:
    """A plan from the initial state, and the reasoning that led to it."""

    actions: tuple[Action | Rejected, ...]
    reasoning: str = ""
    repairs: tuple[str, ...] = ()
    """What had to be mended before the reply could be read."""


@dataclass(frozen=True)
class Outcome:
    """What became of one action."""

    action: Action | Rejected
    failure: Failure | None = None
    notes: tuple[str, ...] = ()
    """What physics did against the plan."""
    reused: bool = False
    """Whether the result was known from an earlier attempt."""
    moved: bool = True
    """False for an action that is feasible without any motion."""


@dataclass(frozen=True)
class Attempt:
    """One turn of the loop: a reply, its rollout, and where it led."""

    number: int
    """Counted from 1."""
    goal: GoalStatus
    proposal: Proposal | None = None
    """None when the reply could not be read."""
    unreadable: Failure | None = None
    """Why the reply could not be read."""
    outcomes: tuple[Outcome, ...] = ()
    """For the actions that were reached; the last one may have failed."""

    @property
    def failure(self) -> Failure | None:
        """What ended the attempt early, if anything did."""
        if self.unreadable:
            return self.unreadable
        return self.outcomes[-1].failure if self.outcomes else None
