"""Planners with one fault each, made from one that has none: straight on, or by way of a point or two."""

from __future__ import annotations

import random
from contextlib import suppress
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


def tested_every(step):
    """Tests lines in samples that are so far apart, by a function of the differences in steps of the resolution."""

    def free(self, space, way):
        lines = [np.linspace(a, b, 1 + max(1, step(b - a, space._problem.resolution))) for a, b in pairwise(way)]
        return space.free(np.vstack(lines)).all()

    return a_planner(free=free)


def skips_what_is_uncertain(self, space, way):
    """Tests what is certainly free, and takes the rest for free."""
    if space._problem.uncertain is None:
        return space.path(way)
    lines = []
    for a, b in pairwise(way):
        steps = max(1, int(np.ceil((np.abs(b - a) / space._problem.resolution).sum())))
        lines.append(np.linspace(a, b, steps + 1)[~space.uncertain(a, b, steps)])
    return space.free(np.vstack(lines)).all()


def for_each_goal(self, problem, rng):
    """A budget for each goal, and not for the query."""
    return a_planner(budget=BUDGET * len(problem.goals)).plan(problem, rng)


def unscaled(self, problem, rng):
    return list(rng.uniform(size=(2, len(problem.start))))


def unscaled_or_refused(self, problem, rng):
    """Draws what other limits do not hold, and goes straight on instead."""
    drawn = rng.uniform(size=(2, len(problem.start)))
    return list(drawn) if ((problem.low <= drawn) & (drawn <= problem.high)).all() else []


def idle(self, problem, rng):
    while True:
        with suppress(Exception):
            rng.uniform()


def endless(self, problem, rng):
    while True:
        problem.valid(rng.uniform(problem.low, problem.high, size=(100_000, len(problem.start))))


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
    "over budget for many goals": Planted(
        a_planner(plan=for_each_goal),
        "the budget is kept",
        "enclosed, with three goals: 599 iterations were spent, and 200 are the budget.",
        "the whole of a query",
    ),
    "samples that are not scaled": Planted(
        a_planner(drawn=unscaled),
        "paths stay within the limits",
        "three joints, around a block: the path goes through (…), outside of (0, -1, 2) to (1, 1, 2.5).",
        "problem.low",
    ),
    "samples that are scaled to nothing": Planted(
        a_planner(drawn=unscaled_or_refused),
        "other limits are no obstacle",
        "around a block in other limits: no path is found, and one is found in the world 'around a block', which is "
        "the same.",
        "between problem.low and problem.high",
    ),
    "paths of two joints": Planted(
        path_with(lambda path: replace(path, waypoints=path.waypoints[:, :2])),
        "answers are paths or failures",
        "three joints: the waypoints have shape (2, 2), and a configuration has 3 values.",
        "(N, dof)",
    ),
    "samples of two joints": Planted(
        a_planner(drawn=lambda self, problem, rng: list(rng.uniform(problem.low[:2], problem.high[:2], size=(2, 2)))),
        "nothing is raised",
        "Planner.plan raised ValueError: all the input array dimensions except for the concatenation axis must match "
        "exactly, but along dimension 1, the array at index 0 has size 3 and the array at index 1 has size 2 (…).",
        "ends a run",
    ),
    "the resolution of the first joint": Planted(
        tested_every(lambda edge, resolution: int(np.ceil(np.abs(edge / resolution[0]).sum()))),
        "every edge is tested",
        "a thin wall across the finer joint: nothing is tested between (…) and (…) of the path, which are 6.8 steps "
        "of the resolution apart.",
        "each joint with its own resolution",
    ),
    "the resolution of the last joint": Planted(
        tested_every(lambda edge, resolution: int(np.ceil(np.abs(edge / resolution[-1]).sum()))),
        "every edge is tested",
        "a thin wall across the first joint: nothing is tested between (…) and (…) of the path, which are … steps of "
        "the resolution apart.",
        "each joint with its own resolution",
    ),
    "steps through a thin wall": Planted(
        tested_every(lambda edge, resolution: int(np.ceil(np.abs(edge / resolution[0]).sum()))),
        "paths are free",
        "a thin wall across the finer joint: the path goes through (…), which is not free.",
        "tested at the resolution",
    ),
    "Euclidean steps": Planted(
        tested_every(lambda edge, resolution: int(np.ceil(np.linalg.norm(edge / resolution)))),
        "every edge is tested",
        "around a block: nothing is tested between (…) and (…) of the path, which are 1.37 steps of the resolution "
        "apart.",
        "not the Euclidean length",
    ),
    "takes what is uncertain for what is free": Planted(
        a_planner(free=skips_what_is_uncertain),
        "paths are free",
        "around a block where what is certainly free is known: the path goes through (…), which is not free.",
        "tested at the resolution",
    ),
    "blames what it never met": Planted(
        failure_with(lambda failure: replace(failure, objects=(*failure.objects, "wall 7"))),
        "what is blamed was touched",
        "start in collision: the failure blames 'wall 7', and nothing that was asked about touches it.",
        "problem.explain",
    ),
    "counts too few tests": Planted(
        a_planner(stats=lambda self, iterations, checks: Stats(0, 0, 0, 0, 0, 1, iterations, checks - 1)),
        "what was spent is told",
        "free: … configurations were tested, and the stats count …",
        "without those that `uncertain` leaves out",
    ),
    "counts no iterations": Planted(
        a_planner(stats=lambda self, iterations, checks: Stats(planner_calls=1, validity_checks=checks)),
        "what was spent is told",
        "around a block: a path around something was found, and the stats count no iteration.",
        "Stats.planner_iterations",
    ),
    "a guard that never struck": Planted(
        a_planner(stats=lambda self, *spent: replace(ByTheWay.stats(self, *spent), time_limited=1)),
        "what was spent is told",
        "free: the stats say that the wall-clock guard cut the query off.",
        "max_seconds",
    ),
    "counts two queries": Planted(
        a_planner(stats=lambda self, *spent: replace(ByTheWay.stats(self, *spent), planner_calls=2)),
        "what was spent is told",
        "free: the stats count 2 queries.",
        "planner_calls=1",
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
