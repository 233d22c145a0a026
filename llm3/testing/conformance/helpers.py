"""What a check of a domain borrows from other plugins, where they can be had."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import dataclass, field
from typing import TypeVar

from llm3.errors import LLM3Error
from llm3.interfaces import FeedbackSynthesizer, MotionPlanner, PlannerSettings
from llm3.prompts import Prompt
from llm3.registry import Registry

PLANNER, FEEDBACK, STRATEGY = "birrt", "categorized", "backtrack"
ITERATIONS = 300
"""What the planner may spend on one query: to find no path is no fault."""
T = TypeVar("T")


@dataclass(frozen=True)
class Helpers:
    """Plugins that work; None where there is none."""

    planner: MotionPlanner | None
    feedback: FeedbackSynthesizer | None
    prompts: Mapping[str, Prompt] = field(default_factory=dict)
    """Those of all strategies that are registered, by name."""

    @classmethod
    def of(cls, registry: Registry) -> Helpers:
        """Those of a registry; one that cannot be made is left out."""
        found = {name: _made(lambda name: Prompt(registry.strategy(name)), name) for name in registry.names("strategy")}
        prompts = {name: prompt for name, prompt in found.items() if prompt}
        planner = _made(lambda name: registry.planner(name, PlannerSettings(ITERATIONS)), PLANNER)
        feedback = _made(registry.feedback, FEEDBACK)
        return cls(planner, feedback, prompts)


def _made(make: Callable[[str], T], name: str) -> T | None:
    try:
        return make(name)
    except LLM3Error:
        return None
