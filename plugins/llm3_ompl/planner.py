"""OMPL's planners as motion planners of llm3."""

from __future__ import annotations

from dataclasses import replace

import numpy as np

from llm3.interfaces import FreeSpace, MotionPlanner, PlannerSettings
from llm3.types import Failure, FailureKind, MotionProblem, Path, Stats
from llm3_ompl.joint_space import JointSpace
from llm3_ompl.search import search
from llm3_ompl.termination import Termination


class OMPLPlanner(MotionPlanner):
    """One of OMPL's geometric planners, with OMPL's default parameters, and OMPL's path simplifier.

    A straight way to any goal wins over a search, the preferred goals first. Every path is tested at the problem's
    resolution before it is returned.

    OMPL's generators take their seeds from one sequence in the process, which each query starts anew. So the same
    generator state gives the same path as long as no other thread uses OMPL during the query.
    """

    def __init__(self, algorithm: str, settings: PlannerSettings) -> None:
        """Plan within these settings; iterations count the search alone, the clock guards the simplifier, too.

        Args:
            algorithm: The name of the planner's class in ``ompl.geometric``, such as ``"RRTConnect"``.
            settings: What one query may spend.
        """
        self._algorithm, self._settings = algorithm, settings

    def plan(self, problem: MotionProblem, rng: np.random.Generator) -> Path | Failure:
        """Find a path from the problem's start to any of its goals; see `MotionPlanner.plan`.

        What `START_IN_COLLISION` and `GOAL_IN_COLLISION` tell is described at `FreeSpace.collision`. `NO_PATH` has the
        measure ``iterations``.

        Raises:
            PluginError: The problem's limits, resolution or validity test are malformed.
        """
        space, termination = FreeSpace(problem), Termination(self._settings)
        start, goals = problem.start, np.array([goal.configuration for goal in problem.goals])

        def spent() -> Stats:
            return Stats(
                planner_calls=1,
                planner_iterations=termination.iterations,
                validity_checks=space.checks,
                time_limited=int(termination.time_limited),
            )

        candidates = space.free_goals()
        if isinstance(candidates, Failure):
            return replace(candidates, stats=spent())
        for index in candidates:
            if space.path(np.vstack([start, goals[index]])):
                return Path(np.vstack([start, goals[index]]), int(index), spent())

        joint_space = JointSpace(space, problem.low, problem.high, np.vstack([start, goals]))
        for waypoints in search(self._algorithm, joint_space, start, goals[candidates], termination, rng):
            reached = candidates[np.linalg.norm(goals[candidates] - waypoints[-1], axis=1).argmin()]
            waypoints[0], waypoints[-1] = start, goals[reached]
            if space.path(waypoints):
                return Path(waypoints, int(reached), spent())
        return Failure(FailureKind.NO_PATH, measures={"iterations": termination.iterations}, stats=spent())
