"""Registers the shipped prompt strategies."""

from __future__ import annotations

from collections.abc import Callable, Mapping

from llm3 import Strategy, hookimpl

PACKAGE = "llm3_templates"


@hookimpl
def llm3_strategies() -> Mapping[str, Callable[[], Strategy]]:
    """The paper's two strategies, and the parameter sampler of its Table II."""
    return {
        "backtrack": lambda: Strategy(
            PACKAGE, "backtrack.j2", "Correct the last plan step by step (the paper's LLM3 Backtrack)."
        ),
        "scratch": lambda: Strategy(PACKAGE, "scratch.j2", "Write a new plan each time (the paper's LLM3 Scratch)."),
        "sample-params": lambda: Strategy(
            PACKAGE,
            "sample-params.j2",
            "The action sequence is given; choose its parameters (the paper's Table II).",
            fixed_sequence=True,
        ),
    }
