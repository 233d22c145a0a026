"""A planner at work on small worlds."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass

import numpy as np

from llm3.interfaces import MotionPlanner
from llm3.testing.conformance.plane import CASES, MOST_TESTS, Case, NoEnd
from llm3.types import Failure, MotionProblem, Path, Vector

SEED = 1


def written(problem: MotionProblem) -> str:
    """All that a planner must leave alone, to compare."""
    arrays = (problem.start, problem.low, problem.high, problem.resolution)
    return repr(([a.tolist() for a in arrays], [goal.configuration for goal in problem.goals]))


@dataclass(frozen=True, eq=False)
class Answer:
    """What a planner answered, and how many configurations it asked about."""

    case: Case
    found: Path | Failure
    tests: int
    left_alone: bool
    """Whether the problem is what it was."""


class Counted:
    """Counts tests, and ends a query that makes far too many."""

    def __init__(self) -> None:
        self.tests = 0

    def add(self, number: int) -> None:
        """So many more."""
        self.tests += number
        if self.tests > MOST_TESTS:
            raise NoEnd


class Planning:
    """A planner at work."""

    def __init__(self, planner: MotionPlanner, max_iterations: int | None) -> None:
        self.planner, self.max_iterations = planner, max_iterations
        self._answers: dict[str, Answer | None] = {}

    def asked(self, case: Case) -> Answer:
        """The planner's answer, given anew.

        Raises:
            NoEnd: It goes on and on.
        """
        counted = Counted()
        problem = case.problem(counted.add)
        before = written(problem)
        found = self.planner.plan(problem, np.random.default_rng(SEED))
        return Answer(case, found, counted.tests, written(problem) == before)

    def endless(self, case: Case) -> bool:
        """Whether a query does not end; asked once."""
        if case.name not in self._answers:
            try:
                self._answers[case.name] = self.asked(case)
            except NoEnd:
                self._answers[case.name] = None
        return self._answers[case.name] is None

    def answers(self) -> Iterator[Answer]:
        """To all cases, each asked once; one that would not end is left out."""
        for case in CASES:
            answer = None if self.endless(case) else self._answers[case.name]
            if answer is not None:
                yield answer

    def paths(self) -> Iterator[tuple[Case, Path, Vector]]:
        """Those that are well-formed paths, with their waypoints."""
        for answer in self.answers():
            if isinstance(answer.found, Path):
                waypoints = np.asarray(answer.found.waypoints, dtype=float)
                if waypoints.ndim == 2 and waypoints.shape[1] == 2 and len(waypoints) and np.isfinite(waypoints).all():
                    yield answer.case, answer.found, waypoints
