"""Counts and times of a run, which add up."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field, fields

from llm3.types.frozen import FrozenDict


@dataclass(frozen=True)
class Stats:
    """What was spent. Components hand back what they spent, and the solver adds it up."""

    llm_calls: int = 0
    """Completions that a backend returned to the loop (the paper's #LM). Owned by the solver."""
    motion_calls: int = 0
    """Actions, not reused, whose motion feasibility was evaluated (the paper's #MP). Owned by the solver."""
    reused_actions: int = 0
    """Actions whose result was known from an earlier attempt. Owned by the solver."""
    unreadable_replies: int = 0
    ik_calls: int = 0
    """Inverse kinematics queries."""
    planner_calls: int = 0
    """Queries to the motion planner's search."""
    planner_iterations: int = 0
    validity_checks: int = 0
    """Configurations tested for collision."""
    time_limited: int = 0
    """Queries that the wall-clock guard cut off: such a run cannot be repeated exactly."""
    prompt_tokens: int = 0
    """Tokens that the model read, those from a cache included."""
    cached_tokens: int = 0
    """Those of them that the server had in a cache, and may charge less for."""
    completion_tokens: int = 0
    """Tokens that the model wrote, those of its reasoning included."""
    reasoning_tokens: int = 0
    """Those of them that it thought before it answered."""
    retries: int = 0
    """Requests to a server that led to nothing: those that were made again, and the last one of a call that failed."""
    step_downs: int = 0
    """Requests made again with fewer features, because the server refused one."""
    seconds: Mapping[str, float] = field(default_factory=FrozenDict)
    """Wall-clock seconds by phase: ``model``, ``prepare``, ``plan``, ``apply``, ``timing``."""

    def __post_init__(self) -> None:
        object.__setattr__(self, "seconds", FrozenDict(self.seconds))

    @property
    def tokens(self) -> int:
        """All tokens, read and written."""
        return self.prompt_tokens + self.completion_tokens

    def __add__(self, other: Stats) -> Stats:
        seconds = dict(self.seconds)
        for phase, value in other.seconds.items():
            seconds[phase] = seconds.get(phase, 0.0) + value
        counts = {f.name: getattr(self, f.name) + getattr(other, f.name) for f in fields(self) if f.name != "seconds"}
        return Stats(**counts, seconds=seconds)
