"""One search by OMPL."""

from __future__ import annotations

from collections.abc import Iterator
from contextlib import contextmanager

import numpy as np
from ompl import base, geometric, util

from llm3.types import Vector
from llm3_ompl.joint_space import JointSpace
from llm3_ompl.termination import Termination


def search(
    algorithm: str, space: JointSpace, start: Vector, goals: Vector, termination: Termination, rng: np.random.Generator
) -> tuple[Vector, ...]:
    """Search a path from the start to any goal.

    Args:
        algorithm: The name of OMPL's class.
        space: The joint space.
        start: A free configuration, shape (dof,).
        goals: Free configurations, shape (N, dof).
        termination: When to stop.
        rng: OMPL's own generators are seeded from it.

    Returns:
        Paths of shape (M, dof), the best first: the simplified one, and the one that was found. Nothing if no path
        to a goal was found; OMPL's approximate solutions, which end elsewhere, are none.

    Source: I. A. Sucan, M. Moll and L. E. Kavraki, "The Open Motion Planning Library", IEEE Robotics & Automation
    Magazine 19(4), 2012.
    """
    with _silent():
        # Every generator that OMPL makes from now on takes its seed from a sequence that this starts anew. OMPL says
        # that it must not be done twice, because generators made earlier go on as before; this query makes its own.
        util.RNG.setSeed(int(rng.integers(1, 2**31)))
        information = space.information()
        problem = base.ProblemDefinition(information)
        problem.addStartState(space.state(information, start))
        region = base.GoalStates(information)
        for goal in goals:
            region.addState(space.state(information, goal))
        problem.setGoal(region)
        planner = getattr(geometric, algorithm)(information)
        planner.setProblemDefinition(problem)
        planner.setup()
        planner.solve(base.PlannerTerminationCondition(termination.search_ends))
        if not problem.hasExactSolution():
            return ()
        path = problem.getSolutionPath()
        found = space.configurations(*path.getStates())
        ends = base.PlannerTerminationCondition(termination.out_of_time)
        geometric.PathSimplifier(information).simplify(path, ends, atLeastOnce=False)
        return space.configurations(*path.getStates()), found


@contextmanager
def _silent() -> Iterator[None]:
    """OMPL writes to the console of the whole process: not from here."""
    level = util.getLogLevel()
    util.setLogLevel(util.LOG_NONE)
    try:
        yield
    finally:
        util.setLogLevel(level)
