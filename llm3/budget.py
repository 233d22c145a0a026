"""What a run may spend."""

from __future__ import annotations

from dataclasses import dataclass
from math import inf

from llm3.errors import UsageError
from llm3.types import Stats, Stop


@dataclass(frozen=True)
class Budget:
    """What a run may spend."""

    max_llm_calls: int = 20
    """The paper's cap on model calls."""
    trace_size: int = 5
    """The paper's k: how many earlier attempts the model is told of."""
    max_tokens: int | None = None
    """No call is made once so many tokens were read and written; None for no limit."""
    max_seconds: float | None = None
    """No call is made after so long, and none takes longer; None for no limit. A search tries no plan after it."""
    max_motion_calls: int | None = None
    """No plan is tried once so many motion calls were made; None for no limit."""

    def __post_init__(self) -> None:
        if self.max_llm_calls < 1:
            raise UsageError(f"the number of model calls must be at least 1, not {self.max_llm_calls}.")
        if self.trace_size < 0:
            raise UsageError(f"the trace size must be 0 or more, not {self.trace_size}.")
        if self.max_tokens is not None and self.max_tokens < 1:
            raise UsageError(f"the number of tokens must be at least 1, not {self.max_tokens}.")
        if self.max_seconds is not None and not 0 < self.max_seconds < inf:
            raise UsageError(f"the seconds of a run must be more than 0, not {self.max_seconds:g}.")
        if self.max_motion_calls is not None and self.max_motion_calls < 1:
            raise UsageError(f"the number of motion calls must be at least 1, not {self.max_motion_calls}.")

    def used_up(self, stats: Stats, seconds: float) -> Stop | None:
        """Which part of it is used up, if any is."""
        if stats.llm_calls >= self.max_llm_calls:
            return "calls"
        if self.max_tokens is not None and stats.tokens >= self.max_tokens:
            return "tokens"
        if self.max_motion_calls is not None and stats.motion_calls >= self.max_motion_calls:
            return "motions"
        if self.max_seconds is not None and seconds >= self.max_seconds:
            return "seconds"
        return None
