"""What one query may spend."""

from __future__ import annotations

from llm3.interfaces import PlannerSettings


class Budget:
    """Counts iterations, and watches the clock as a guard.

    Only iterations decide in a run that goes as foreseen, so that a busy machine gives the same answer.
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

    @property
    def is_spent(self) -> bool:
        """Whether the iterations are used up, or the guard has struck."""
        return self.time_limited or self.iterations >= self._max_iterations

    def spend(self) -> bool:
        """Take one iteration; False when none is left."""
        if self.is_spent or not self.in_time():
            return False
        self.iterations += 1
        return True

    def in_time(self) -> bool:
        """Whether the guard lets the work go on; ask only where there is work left to do."""
        if self._clock() >= self._deadline:
            self.time_limited = True
        return not self.time_limited
