"""The planners that are compared, each ready to answer one query."""

from __future__ import annotations

import random
from collections.abc import Callable, Iterator, Mapping
from contextlib import AbstractContextManager, contextmanager
from dataclasses import dataclass
from functools import partial

import numpy as np
from ompl import base, geometric, util
from published_checker import published_checker, pybullet_planning
from queries import Query

from llm3.interfaces import FreeSpace, PlannerSettings
from llm3.types import MotionProblem, Path, Vector
from llm3_birrt.planner import BiRRT
from llm3_bullet.workcell import Workcell
from llm3_ompl.joint_space import JointSpace

OMPL_RESOLUTION = 0.003
"""Distance of OMPL's samples as a fraction of the space's extent: 0.038 rad for a Panda, several times farther than
those of our planner. At 0.01 half of its paths fail a dense re-check."""
SECONDS = 30.0
"""A guard on one query, the default of llm3."""


@dataclass(frozen=True, eq=False)
class Answer:
    """What a planner found."""

    waypoints: Vector | None
    """Shape (N, dof); None without a path."""
    verdicts: int
    """Configurations that were tested."""


Solve = Callable[[int], Answer]
"""Answers the query with this seed."""
Planner = Callable[[Query, Workcell], AbstractContextManager[Solve]]
"""Sets up for a query: what happens here is not timed."""


def warm_up(problem: MotionProblem) -> None:
    """The first questions of a scene move its boxes to their places, and prepare what many questions need."""
    for count in (1, 100):
        problem.valid(np.repeat(problem.start[None], count, axis=0))


@contextmanager
def birrt(query: Query, cell: Workcell, simplify: bool) -> Iterator[Solve]:
    """This planner."""
    problem, planner = query.problem(cell), BiRRT(PlannerSettings(max_seconds=SECONDS), shortcuts=simplify)

    def solve(seed: int) -> Answer:
        answer = planner.plan(problem, np.random.default_rng(seed))
        return Answer(answer.waypoints if isinstance(answer, Path) else None, answer.stats.validity_checks)

    warm_up(problem)
    yield solve


@contextmanager
def published(query: Query, cell: Workcell) -> Iterator[Solve]:
    """pybullet-planning's birrt as the published implementation of LLM3 calls it, every parameter at its default.

    It plans for the arm and the fingers, samples edges at 0.05 rad, keeps no clearance, restarts twice with 20
    iterations each and smooths with 20.
    """
    planning, description = pybullet_planning(), cell.model.description
    with published_checker(description, query.scene) as checker:
        body, joints, limits = checker.robot, checker.joints, dict(checker.limits)
        sample, distance = planning.get_sample_fn(body, joints, limits), planning.get_distance_fn(body, joints)
        extend, fingers = planning.get_extend_fn(body, joints), checker.fingers
        dof = len(query.start)

        def solve(seed: int) -> Answer:
            random.seed(seed)
            np.random.seed(seed)  # noqa: NPY002  # pybullet-planning draws from the global generators
            verdicts = 0

            def collides(q: object, **options: object) -> bool:
                nonlocal verdicts
                verdicts += 1
                return checker.collides(q, **options)

            start, goal = (*query.start, *fingers), (*query.goal, *fingers)
            path = planning.birrt(start, goal, distance, sample, extend, collides)
            return Answer(None if path is None else np.array(path)[:, :dof], verdicts)

        yield solve


@contextmanager
def ompl(query: Query, cell: Workcell, simplify: bool, batched: bool) -> Iterator[Solve]:
    """OMPL's RRTConnect over our verdict. It asks for one configuration at a time, or for whole lines, in batches."""
    problem = query.problem(cell)
    goal = np.array(query.goal)

    def solve(seed: int) -> Answer:
        util.RNG.setSeed(seed + 1)
        space = FreeSpace(problem)
        joint_space = JointSpace(space, problem.low, problem.high, np.array([problem.start, goal]))
        information = joint_space.information() if batched else one_at_a_time(space, problem.low, problem.high)
        definition = base.ProblemDefinition(information)
        definition.setStartAndGoalStates(*(joint_space.state(information, q) for q in (problem.start, goal)))
        planner = geometric.RRTConnect(information)
        planner.setProblemDefinition(definition)
        planner.setup()
        planner.solve(base.timedPlannerTerminationCondition(SECONDS))
        if not definition.hasExactSolution():
            return Answer(None, space.checks)
        path = definition.getSolutionPath()
        if simplify:
            geometric.PathSimplifier(information).simplifyMax(path)
        return Answer(joint_space.configurations(*path.getStates()), space.checks)

    warm_up(problem)
    level = util.getLogLevel()
    util.setLogLevel(util.LOG_NONE)
    yield solve
    util.setLogLevel(level)


def one_at_a_time(space: FreeSpace, low: Vector, high: Vector) -> base.SpaceInformation:
    """OMPL as it comes: it samples lines at a fraction of the space's extent and asks for each sample."""
    bounds = base.RealVectorBounds(len(low))
    bounds.low, bounds.high = low.tolist(), high.tolist()
    states = base.RealVectorStateSpace(len(low))
    states.setBounds(bounds)
    information = base.SpaceInformation(states)
    information.setStateValidityChecker(lambda state: bool(space.free(np.array([state[0 : len(low)]]))[0]))
    information.setStateValidityCheckingResolution(OMPL_RESOLUTION)
    information.setup()
    return information


OURS, OURS_RAW = "birrt", "birrt, not shortened"
PUBLISHED = "pybullet-planning's birrt"
OMPL, OMPL_RAW = "OMPL RRTConnect", "OMPL RRTConnect, not simplified"
BATCHED, BATCHED_RAW = "OMPL over our batched lines", "OMPL over our batched lines, not simplified"
PLANNERS: Mapping[str, Planner] = {
    OURS: partial(birrt, simplify=True),
    OURS_RAW: partial(birrt, simplify=False),
    PUBLISHED: published,
    OMPL: partial(ompl, simplify=True, batched=False),
    OMPL_RAW: partial(ompl, simplify=False, batched=False),
    BATCHED: partial(ompl, simplify=True, batched=True),
    BATCHED_RAW: partial(ompl, simplify=False, batched=True),
}
