"""Every rule of the kit, by the kind of plugin that it is for."""

from __future__ import annotations

import inspect
from collections.abc import Mapping
from dataclasses import dataclass
from typing import Any

from llm3.testing.conformance import backend, domain_rules, feedback, planner, strategy, timer
from llm3.testing.conformance.inspection import RAISES, Rule, name_of


@dataclass(frozen=True)
class Law:
    """A rule as it is told."""

    name: str
    """As in `Complaint.rule`."""
    text: str
    """What is so in every plugin that keeps the rule: a sentence."""


def laws() -> Mapping[str, tuple[Law, ...]]:
    """All rules by the kind of plugin, in the order in which they are looked at."""
    rules: dict[str, tuple[str, tuple[Rule[Any], ...]]] = {
        "domain": (domain_rules.INSTEAD, domain_rules.RULES),
        "planner": (planner.INSTEAD, planner.RULES),
        "feedback": (feedback.INSTEAD, feedback.RULES),
        "backend": (backend.INSTEAD, backend.RULES),
        "strategy": (strategy.INSTEAD, strategy.RULES),
        "timer": (timer.INSTEAD, timer.RULES),
    }
    return {kind: (_no_exception(instead), *map(_law, of_kind)) for kind, (instead, of_kind) in rules.items()}


def _no_exception(instead: str) -> Law:
    return Law(RAISES, f"No method raises an exception: {instead}.")


def _law(rule: Rule[Any]) -> Law:
    return Law(name_of(rule), inspect.getdoc(rule) or "")
