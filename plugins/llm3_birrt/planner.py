"""The planner: straight to a goal where that is free, else RRT-Connect and shortcuts."""

from __future__ import annotations

from dataclasses import replace

import numpy as np

from llm3.interfaces import MotionPlanner, PlannerSettings
from llm3.types import Failure, FailureKind, MotionProblem, Path, Stats
from llm3_birrt.budget import Budget
from llm3_birrt.connect import Gap, Stop, rrt_connect
from llm3_birrt.evidence import no_path
from llm3_birrt.joint_space import JointSpace
from llm3_birrt.shorten import shorten


class BiRRT(MotionPlanner):
    """A bidirectional RRT over any joint space with finite limits; distances are Euclidean.

    A straight way to any goal wins over a search, the preferred goals first. The search looks for all goals at
    once and takes the first one that it reaches. Start and goals are taken as they are; every waypoint between
    them is within the limits.
    """

    def __init__(self, settings: PlannerSettings, shortcuts: bool = True) -> None:
        """Plan within these settings; iterations count the search alone, the clock guards all of it.

        Args:
            settings: What one query may spend.
            shortcuts: Shorten what the search finds.
        """
        self._settings, self._shortcuts = settings, shortcuts

    def plan(self, problem: MotionProblem, rng: np.random.Generator) -> Path | Failure:
        """Find a path from the problem's start to any of its goals; see `MotionPlanner.plan`.

        Collisions at the start and at all goals are told as `FreeSpace.collision` tells them, and a search that
        fails as `llm3_birrt.evidence.no_path` does.

        Raises:
            PluginError: The problem's limits, resolution or validity test are malformed.
        """
        space, budget = JointSpace(problem), Budget(self._settings)

        def spent() -> Stats:
            return Stats(
                planner_calls=1,
                planner_iterations=budget.iterations,
                validity_checks=space.checks,
                time_limited=int(budget.time_limited),
            )

        start = problem.start
        if not space.free(start[None]).all():
            return replace(space.collision(FailureKind.START_IN_COLLISION, start[None]), stats=spent())
        candidates: list[int] = []
        stops: list[Stop] = []
        for index, goal in enumerate(problem.goals):  # those behind a goal with a straight way need not be made
            end = np.array(goal.configuration)
            blocked = space.obstacle(start, end)
            if blocked is None:
                return Path(np.vstack([start, end]), index, spent())
            if not np.array_equal(blocked, end):
                candidates.append(index)
                stops.append(Stop(blocked, float(np.linalg.norm(end - start))))
        goals = np.array([goal.configuration for goal in problem.goals])
        if not candidates:
            return replace(space.collision(FailureKind.GOAL_IN_COLLISION, goals), stats=spent())

        found = rrt_connect(space, start, goals[candidates], budget, rng)
        if isinstance(found, Gap):
            return no_path(problem, found, (*stops, *found.stops), spent())
        waypoints = shorten(found.waypoints, space, rng, budget.in_time) if self._shortcuts else found.waypoints
        return Path(waypoints, candidates[found.root], spent())
