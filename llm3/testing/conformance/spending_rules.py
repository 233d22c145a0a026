"""Rules for what a motion planner says that it spent."""

from __future__ import annotations

from collections.abc import Iterator

import numpy as np

from llm3.testing.conformance.inspection import Fault
from llm3.testing.conformance.planning import Planning
from llm3.types import Path


def the_budget_is_kept(planning: Planning) -> Iterator[Fault]:
    """No query says that it took more iterations than it was given, however many goals there are."""
    most = planning.max_iterations
    for case, found, _ in planning.told():
        spent = found.stats.planner_iterations
        if most is not None and spent > most:
            yield Fault(
                f"{case.name}: {spent} iterations were spent, and {most} are the budget.",
                "max_iterations bounds the whole of a query, whatever number of searches it makes.",
            )


def what_was_spent_is_told(planning: Planning) -> Iterator[Fault]:
    """Stats count the query and the tests, nothing that is the solver's to count, and no wall-clock guard was hit."""
    for case, found, questions in planning.told():
        stats = found.stats
        if stats.llm_calls or stats.motion_calls or stats.reused_actions:
            yield Fault(f"{case.name}: the stats count calls of the solver.", "Those are counted by the solver.")
        if stats.validity_checks != questions.tests:
            yield Fault(
                f"{case.name}: {questions.tests} configurations were tested, and the stats count "
                f"{stats.validity_checks or 'none'}.",
                "Hand back in Stats.validity_checks how many configurations `valid` was given, of failures, too, and "
                "without those that `uncertain` leaves out; FreeSpace.checks counts.",
            )
        if stats.planner_calls != 1:
            text = f"{case.name}: the stats count {stats.planner_calls or 'no'} {_QUERY[stats.planner_calls > 1]}."
            yield Fault(text, "Hand back Stats(planner_calls=1, …) with every path and failure.")
        bends = isinstance(found, Path) and len(np.atleast_1d(found.waypoints)) > 2
        if bends and not case.straight and stats.planner_iterations < 1:
            yield Fault(
                f"{case.name}: a path around something was found, and the stats count no iteration.",
                "Hand back in Stats.planner_iterations what the search took of max_iterations.",
            )
        if stats.time_limited:
            yield Fault(
                f"{case.name}: the stats say that the wall-clock guard cut the query off.",
                "time_limited is for a query that max_seconds ended; one that max_iterations ended counts none.",
            )


_QUERY = ("query", "queries")
RULES = (the_budget_is_kept, what_was_spent_is_told)
