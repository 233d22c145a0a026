"""The check of a motion planner."""

from __future__ import annotations

from llm3.interfaces import MotionPlanner
from llm3.testing.conformance import path_rules, planner_rules
from llm3.testing.conformance.complaint import Complaint, Report
from llm3.testing.conformance.inspection import Inspection
from llm3.testing.conformance.plane import CASES
from llm3.testing.conformance.planning import Planning
from llm3.types import Path

INSTEAD = "what cannot be planned is a Failure, and not an exception"
RULES = (*planner_rules.RULES, *path_rules.RULES)


def check_planner(planner: MotionPlanner, *, max_iterations: int | None = None) -> tuple[Complaint, ...]:
    """Look for faults in a motion planner, on small worlds in the plane.

    Args:
        planner: The planner.
        max_iterations: The budget that it was made with, to see that it is kept; None: that is not looked at.
    """
    return examine_planner(planner, max_iterations=max_iterations).complaints


def examine_planner(planner: MotionPlanner, *, max_iterations: int | None = None) -> Report:
    """Like :func:`check_planner`, with the remarks and with what was looked at."""
    inspection = Inspection(INSTEAD)
    planning = Planning(planner, max_iterations)
    inspection.apply(RULES, planning)
    inspection.worlds = len(CASES)
    for case in CASES:
        possible = not case.failure and not inspection.report.complaints
        if possible and not isinstance(planning.asked(case).found, Path):
            inspection.remark(f"In the world {case.name!r} it finds no path.")
    return inspection.report
