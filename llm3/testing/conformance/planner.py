"""The check of a motion planner."""

from __future__ import annotations

from llm3.interfaces import MotionPlanner
from llm3.testing.conformance import path_rules, planner_rules, spending_rules
from llm3.testing.conformance.complaint import Complaint, Report
from llm3.testing.conformance.inspection import Inspection
from llm3.testing.conformance.plane import CASES
from llm3.testing.conformance.planning import PATIENCE, Planning
from llm3.testing.conformance.watchdog import can_watch
from llm3.types import Path

INSTEAD = "what cannot be planned is a Failure, and not an exception"
RULES = (*planner_rules.RULES, *spending_rules.RULES, *path_rules.RULES)


def check_planner(
    planner: MotionPlanner, *, max_iterations: int | None = None, patience: float = PATIENCE
) -> tuple[Complaint, ...]:
    """Look for faults in a motion planner, on small worlds with two or three joints.

    Args:
        planner: The planner.
        max_iterations: The budget that it was made with, to see that it is kept; None: that is not looked at.
        patience: Seconds that a query may take. One that takes longer is ended by an alarm signal: on a POSIX system,
            in the main thread, where no other alarm is set. Elsewhere a remark says that nothing would end it.
    """
    return examine_planner(planner, max_iterations=max_iterations, patience=patience).complaints


def examine_planner(planner: MotionPlanner, *, max_iterations: int | None = None, patience: float = PATIENCE) -> Report:
    """Like :func:`check_planner`, with the remarks and with what was looked at."""
    inspection = Inspection(INSTEAD)
    planning = Planning(planner, max_iterations, patience)
    inspection.apply(RULES, planning)
    inspection.worlds = len(CASES)
    if not can_watch():
        inspection.remark("There was no alarm to be had, so a query that does not end would not have been ended.")
    for answer in planning.answers():
        possible = not answer.case.failure and not inspection.report.complaints
        if possible and not isinstance(answer.found, Path):
            inspection.remark(f"In the world {answer.case.name!r} it finds no path.")
    return inspection.report
