"""The planner: straight to a goal where that is free, else RRT-Connect and shortcuts."""

from __future__ import annotations

import numpy as np

from llm3.interfaces import MotionPlanner, PlannerSettings
from llm3.types import Contact, Failure, FailureKind, MotionProblem, Path, Stats, Vector
from llm3_birrt.budget import Budget
from llm3_birrt.connect import Gap, rrt_connect
from llm3_birrt.free_space import FreeSpace
from llm3_birrt.shorten import shorten


class BiRRT(MotionPlanner):
    """A bidirectional RRT over any joint space with finite limits; distances are Euclidean.

    A straight way to any goal wins over a search, the preferred goals first. The search looks for all goals at
    once and takes the first one that it reaches. Start and goals are taken as they are; every waypoint between
    them is within the limits.
    """

    def __init__(self, settings: PlannerSettings) -> None:
        """Plan within these settings; iterations count the search alone, the clock guards all of it."""
        self._settings = settings

    def plan(self, problem: MotionProblem, rng: np.random.Generator) -> Path | Failure:
        """Find a path from the problem's start to any of its goals; see `MotionPlanner.plan`.

        `GOAL_IN_COLLISION` tells the contacts of the goal that is nearest to being free. `NO_PATH` has the measures
        ``iterations``, ``gap`` (the smallest joint-space distance at which an attempt to join the trees was stopped),
        and ``start_tree`` and ``goal_tree`` (how many nodes those trees had).

        Raises:
            PluginError: The problem's limits, resolution or validity test are malformed.
        """
        space, budget = FreeSpace(problem), Budget(self._settings)
        start, goals = problem.start, np.array([goal.configuration for goal in problem.goals])
        start_free, *goals_free = space.free(np.vstack([start, goals]))
        if not start_free:
            at = problem.start, problem.explain(start)
            return _collision(FailureKind.START_IN_COLLISION, *at, _spent(space, budget))
        candidates = np.flatnonzero(goals_free)
        if not len(candidates):
            at = _nearest_to_free(problem, goals)
            return _collision(FailureKind.GOAL_IN_COLLISION, *at, _spent(space, budget))

        for index in candidates:
            if space.edge(start, goals[index]):
                return Path(np.vstack([start, goals[index]]), int(index), _spent(space, budget))

        found = rrt_connect(space, start, goals[candidates], budget, rng)
        if isinstance(found, Gap):
            return _no_path(found, _spent(space, budget))
        waypoints = shorten(found.waypoints, space, rng, budget.in_time)
        return Path(waypoints, int(candidates[found.root]), _spent(space, budget))


def _spent(space: FreeSpace, budget: Budget) -> Stats:
    return Stats(
        planner_calls=1,
        planner_iterations=budget.iterations,
        validity_checks=space.checks,
        time_limited=int(budget.time_limited),
    )


def _collision(kind: FailureKind, q: Vector, contacts: tuple[Contact, ...], stats: Stats) -> Failure:
    deepest_first = tuple(sorted(contacts, key=lambda contact: -contact.depth))
    objects = tuple(dict.fromkeys(contact.object for contact in deepest_first))
    return Failure(kind, objects=objects, contacts=deepest_first, configuration=tuple(q.tolist()), stats=stats)


def _nearest_to_free(problem: MotionProblem, goals: Vector) -> tuple[Vector, tuple[Contact, ...]]:
    """The goal whose deepest contact is the shallowest, and its contacts; one that cannot be explained comes last."""
    explained = ((goal, problem.explain(goal)) for goal in goals)
    return min(explained, key=lambda found: max((c.depth for c in found[1]), default=np.inf))


def _no_path(gap: Gap, stats: Stats) -> Failure:
    measures = {
        "iterations": stats.planner_iterations,
        "start_tree": gap.start_tree,
        "goal_tree": gap.goal_tree,
        "gap": gap.distance,
    }
    return Failure(FailureKind.NO_PATH, measures=measures, stats=stats)
