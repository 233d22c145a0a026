"""A planner at work on small worlds."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass, field

import numpy as np

from llm3.interfaces import MotionPlanner
from llm3.testing.conformance.plane import CASES, Case
from llm3.testing.conformance.watchdog import NoEnd, watched
from llm3.types import Contact, Failure, MotionProblem, Path, Vector

SEED = 1
MOST_TESTS = 2_000_000
"""How many configurations may be asked about in one query; whoever asks for more does not keep to a budget."""
PATIENCE = 60.0
"""Seconds that a query may take."""


def written(problem: MotionProblem) -> str:
    """All that a planner must leave alone, to compare."""
    arrays = (problem.start, problem.low, problem.high, problem.resolution)
    return repr(([a.tolist() for a in arrays], [goal.configuration for goal in problem.goals]))


@dataclass(eq=False)
class Questions:
    """What a planner asks in one query; a query that asks far too much is ended."""

    batches: list[Vector] = field(default_factory=list)
    tests: int = 0
    """How many configurations it asked about."""
    blamed: set[str] = field(default_factory=set)
    """The objects that it was told are touched somewhere."""

    def asked(self, points: Vector) -> None:
        """Keep what is asked about, shape (N, dof)."""
        self.tests += len(points)
        if self.tests > MOST_TESTS:
            raise NoEnd
        self.batches.append(np.array(points, dtype=float))

    def explained(self, contacts: tuple[Contact, ...]) -> None:
        """Keep what was told of one configuration."""
        self.blamed.update(contact.object for contact in contacts)


@dataclass(frozen=True, eq=False)
class Answer:
    """What a planner answered, and what it asked before."""

    case: Case
    found: Path | Failure
    questions: Questions
    left_alone: bool
    """Whether the problem is what it was."""


class Planning:
    """A planner at work."""

    def __init__(self, planner: MotionPlanner, max_iterations: int | None, patience: float) -> None:
        self.planner, self.max_iterations, self.patience = planner, max_iterations, patience
        self.endless = ""
        """What became of a query that did not end: the end of a sentence."""
        self.error: Exception | SystemExit | None = None
        """What it raised first."""
        self._answers: list[Answer] | None = None

    def asked(self, case: Case) -> Answer | None:
        """The planner's answer, given anew; None if it goes on and on."""
        questions = Questions()
        problem = case.problem(questions.asked, questions.explained)
        before = written(problem)
        try:
            with watched(self.patience):
                found = self.planner.plan(problem, np.random.default_rng(SEED))
        except NoEnd:
            asks = f"asks about more than {MOST_TESTS:,} configurations and does not end"
            takes = f"does not end within {self.patience:g} s"
            self.endless = f"{case.name}: the planner {asks if questions.tests > MOST_TESTS else takes}."
            return None
        return Answer(case, found, questions, written(problem) == before)

    def answers(self) -> list[Answer]:
        """To all cases, each asked once; without those that raise, and those from one on that does not end."""
        if self._answers is None:
            self._answers = []
            for case in CASES:
                try:
                    answer = self.asked(case)
                except (Exception, SystemExit) as error:  # a plugin may raise anything
                    self.error = self.error or error
                    continue
                if answer is None:
                    break
                self._answers.append(answer)
        return self._answers

    def told(self) -> Iterator[tuple[Case, Path | Failure, Questions]]:
        """Those that are paths or failures."""
        for answer in self.answers():
            if isinstance(answer.found, Path | Failure):
                yield answer.case, answer.found, answer.questions

    def paths(self) -> Iterator[tuple[Case, Path, Vector]]:
        """Those that are well-formed paths, with their waypoints."""
        for case, found, _ in self.told():
            if isinstance(found, Path):
                waypoints = np.asarray(found.waypoints, dtype=float)
                formed = waypoints.ndim == 2 and waypoints.shape[1] == case.dof and len(waypoints) > 0
                if formed and np.isfinite(waypoints).all():
                    yield case, found, waypoints
