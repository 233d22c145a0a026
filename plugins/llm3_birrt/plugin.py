"""Registers the planner ``birrt``."""

from __future__ import annotations

from collections.abc import Callable, Mapping

from llm3.hookspecs import hookimpl
from llm3.interfaces import MotionPlanner, PlannerSettings


@hookimpl
def llm3_planners() -> Mapping[str, Callable[[PlannerSettings], MotionPlanner]]:
    """The planner of this package."""
    return {"birrt": _birrt}


def _birrt(settings: PlannerSettings) -> MotionPlanner:
    """Bidirectional rapidly-exploring random trees, after a direct connection, with shortcuts."""
    from llm3_birrt.planner import BiRRT

    return BiRRT(settings)
