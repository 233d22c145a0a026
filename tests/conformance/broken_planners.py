"""Planners with one fault each, made from one that has none: straight on, or by way of a point or two."""

from __future__ import annotations

import random
from dataclasses import replace
from itertools import pairwise

import numpy as np
from planted import Planted

from llm3 import MotionPlanner
from llm3.interfaces import FreeSpace
from llm3.types import Failure, FailureKind, Path, Stats

BUDGET = 200
"""Ways that are tried."""


class ByTheWay(MotionPlanner):
    """Tries the straight way, and then ways around that are drawn."""

    budget = BUDGET

    def plan(self, problem, rng):
        space, iterations = FreeSpace(problem), 0
        free = self.goals(space)
        if not isinstance(free, Failure):
            ends = [(int(i), np.array(problem.goals[int(i)].configuration)) for i in free]
            for iterations in range(self.budget):
                index, end = ends[iterations % len(ends)]
                around = [] if iterations < len(ends) else self.drawn(problem, rng)
                way = np.vstack([problem.start, *around, end])
                if self.free(space, way):
                    return self.told(Path(way, index, self.stats(iterations, space.checks)), problem)
        failure = free if isinstance(free, Failure) else Failure(FailureKind.NO_PATH)
        return self.told(replace(failure, stats=self.stats(iterations, space.checks)), problem)

    def goals(self, space):
        return space.free_goals()

    def free(self, space, way):
        return space.path(way)

    def drawn(self, problem, rng):
        between = rng.uniform(problem.low, problem.high, size=(2, len(problem.start)))
        return [between[0], between[1]]

    def stats(self, iterations, checks):
        return Stats(planner_calls=1, planner_iterations=iterations, validity_checks=checks)

    def told(self, answer, problem):
        return answer


def a_planner(**parts):
    return type("Planner", (ByTheWay,), parts)()


def path_with(change):
    """A planner whose paths are changed before they are told."""
    return a_planner(told=lambda self, answer, problem: change(answer) if isinstance(answer, Path) else answer)


def failure_with(change):
    return a_planner(told=lambda self, answer, problem: change(answer) if isinstance(answer, Failure) else answer)


def endless(self, problem, rng):
    while True:
        problem.valid(rng.uniform(problem.low, problem.high, size=(100_000, 2)))


def only_the_first(self, space):
    """Refuses a query whose first goal is in collision."""
    free = space.free_goals()
    goal = np.array(space._problem.goals[0].configuration)[None]
    return free if isinstance(free, Failure) or 0 in free else space.collision(FailureKind.GOAL_IN_COLLISION, goal)


def never_looks(self, space):
    return np.arange(len(space._problem.goals))


def restless():
    seen = []

    def drawn(self, problem, rng):
        seen.append(1)
        return ByTheWay.drawn(self, problem, np.random.default_rng(len(seen)))

    return drawn


def shared(self, problem, rng):
    return ByTheWay.drawn(self, problem, np.random.default_rng(random.getrandbits(32)))


def wide(self, problem, rng):
    return list(rng.uniform(problem.low - 0.5, problem.high + 0.5, size=(2, 2)))


def coarse(self, space, way):
    points = np.vstack([np.linspace(a, b, 4) for a, b in pairwise(way)])
    return space.free(points).all()


def in_place(self, problem, rng):
    found = ByTheWay.plan(self, problem, rng)
    np.add(problem.start, 0.1, out=problem.start)
    return found


FAULTS: dict[str, Planted] = {
    "does not end": Planted(
        a_planner(plan=endless),
        "every query ends",
        "free: the planner asks about more than 2,000,000 configurations and does not end.",
        "PlannerSettings.max_iterations",
    ),
    "answers nothing": Planted(
        failure_with(lambda answer: None),
        "answers are paths or failures",
        "start in collision: plan answers None.",
        "never None",
    ),
    "one configuration": Planted(
        path_with(lambda path: Path(path.waypoints[-1])),
        "answers are paths or failures",
        "free: the waypoints have shape (2,), and a configuration has 2 values.",
        "(N, dof)",
    ),
    "begins elsewhere": Planted(
        path_with(lambda path: replace(path, waypoints=path.waypoints[1:])),
        "paths lead from the start to their goal",
        "free: the path begins at (0.8, 0.5), and the start is (0.2, 0.5).",
        "first waypoint",
    ),
    "ends short": Planted(
        path_with(
            lambda path: replace(path, waypoints=np.vstack([path.waypoints[:-1], path.waypoints[-1] - (0.01, 0.0)]))
        ),
        "paths lead from the start to their goal",
        "free: the path ends at (0.79, 0.5), and goal 0 is (0.8, 0.5).",
        "last waypoint",
    ),
    "another goal": Planted(
        path_with(lambda path: replace(path, goal_index=0)),
        "paths lead from the start to their goal",
        "many goals, the first in collision: the path ends at (…), and goal 0 is (0.5, 0.5).",
        "goals in collision count, too",
    ),
    "no such goal": Planted(
        path_with(lambda path: replace(path, goal_index=7)),
        "paths lead from the start to their goal",
        "free: goal_index is 7, and there are 1 goals.",
        "from 0",
    ),
    "outside of the limits": Planted(
        a_planner(drawn=wide),
        "paths stay within the limits",
        "…: the path goes through (…), outside of (0, 0) to (1, 1).",
        "problem.low",
    ),
    "through walls": Planted(
        a_planner(free=lambda self, space, way: space.free(way).all()),
        "paths are free",
        "around a block: the path goes through (…), which is not free.",
        "tested at the resolution",
    ),
    "coarse steps": Planted(
        a_planner(free=coarse),
        "paths are free",
        "…: the path goes through (…), which is not free.",
        "neighbouring samples",
    ),
    "start is not tested": Planted(
        a_planner(goals=never_looks),
        "what cannot be is refused",
        "start in collision: the planner answers 'no path within budget', and not 'start in collision'.",
        "FreeSpace.free_goals",
    ),
    "refuses for the first goal": Planted(
        a_planner(goals=only_the_first),
        "what cannot be is refused",
        "many goals, the first in collision: the planner answers 'goal in collision', and start and a goal are free.",
        "only if all are",
    ),
    "blames nothing": Planted(
        failure_with(lambda failure: replace(failure, objects=())),
        "what cannot be is refused",
        "start in collision: the failure blames (), and 'wall 0' is in the way.",
        "problem.explain",
    ),
    "finds nothing": Planted(
        a_planner(budget=0),
        "easy paths are found",
        "free: no path is found, but 'no path within budget'.",
        "try it first",
    ),
    "over budget": Planted(
        a_planner(budget=10 * BUDGET),
        "the budget is kept",
        "enclosed: 1999 iterations were spent, and 200 are the budget.",
        "the whole of a query",
    ),
    "counts no tests": Planted(
        a_planner(stats=lambda self, iterations, checks: Stats(planner_calls=1)),
        "what was spent is told",
        "free: … configurations were tested, and the stats count none.",
        "FreeSpace.checks",
    ),
    "counts motion calls": Planted(
        a_planner(stats=lambda self, iterations, checks: Stats(1, 1, planner_calls=1, validity_checks=checks)),
        "what was spent is told",
        "free: the stats count calls of the solver.",
        "counted by the solver",
    ),
    "counts no query": Planted(
        a_planner(stats=lambda self, iterations, checks: Stats(validity_checks=checks)),
        "what was spent is told",
        "free: the stats count no query.",
        "planner_calls=1",
    ),
    "its own generator": Planted(
        a_planner(drawn=restless()),
        "the same generator gives the same path",
        "…: the same generator gives two answers.",
        "keep nothing between queries",
    ),
    "everybody's generator": Planted(
        a_planner(drawn=shared),
        "chance is the generator that is given",
        "a query draws from the global generator of random or numpy.",
        "the rng that plan is given",
    ),
    "changes its problem": Planted(
        a_planner(plan=in_place),
        "problems are left alone",
        "free: a query changes its problem.",
        "Copy problem.start",
    ),
    "raises": Planted(
        a_planner(plan=lambda self, problem, rng: [][0]),
        "nothing is raised",
        "Planner.<lambda> raised IndexError: list index out of range (broken_planners.py:…).",
        "ends a run",
    ),
}
