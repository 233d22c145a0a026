"""When OMPL has to stop."""

from __future__ import annotations

from llm3.interfaces import PlannerSettings


class Termination:
    """Counts a search's iterations, and watches the clock as a guard.

    OMPL's planners ask before each iteration whether to stop, so the answers "go on" are the iterations.
    """

    def __init__(self, settings: PlannerSettings) -> None:
        """Start the clock."""
        self._max_iterations = settings.max_iterations
        self._clock = settings.clock
        self._deadline = settings.clock() + settings.max_seconds
        self.iterations = 0
        """Iterations spent so far."""
        self.time_limited = False
        """Whether the guard cut something off."""

    def search_ends(self) -> bool:
        """Whether a search has to stop; takes one iteration where it may go on."""
        if self.iterations >= self._max_iterations or self.out_of_time():
            return True
        self.iterations += 1
        return False

    def out_of_time(self) -> bool:
        """Whether the guard strikes; ask only where there is work left to do."""
        if self._clock() >= self._deadline:
            self.time_limited = True
        return self.time_limited
