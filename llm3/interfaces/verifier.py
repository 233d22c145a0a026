"""A second look at a plan."""

from __future__ import annotations

from abc import ABC, abstractmethod

from llm3.types import PlannedAction, State, Verification


class PlanVerifier(ABC):
    """Plays a plan of one problem in a world of its own, and tells whatever is wrong with it.

    It believes nothing that the plan says, and shares no code with whatever made the plan: a mistake there must not
    hide itself here.
    """

    @abstractmethod
    def verify(self, start: State, actions: tuple[PlannedAction, ...]) -> Verification:
        """Play the plan from its start, and ask at its end whether the goal is reached.

        Args:
            start: The state in which the plan says that it begins.
            actions: The plan. Its actions fit the schemas and name objects that there are, its configurations have
                the right number of joint values, and no segment is without waypoints. Nothing else is known of it.
        """
