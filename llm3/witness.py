"""Proves that a problem can be solved: carries out the actions of which its domain knows that they solve it."""

from __future__ import annotations

from time import perf_counter

from llm3.assembly import Problem
from llm3.errors import LLM3Error, UsageError
from llm3.guarded import guarded
from llm3.interfaces import MotionPlanner, TrajectoryTimer
from llm3.records import PlanFile
from llm3.records.plan import plan_file
from llm3.rollout import Roller
from llm3.timing import timed
from llm3.types import State
from llm3.verification import verify
from llm3.wording import failure_in_words


def witness(
    problem: Problem, setting: str, seed: int, planner: MotionPlanner, timer: TrajectoryTimer | None = None
) -> PlanFile:
    """A sound plan for a problem that was made from a setting and a seed, where its domain knows one.

    Args:
        problem: The problem.
        setting: Where it is from,
        seed: and which one of these it is.
        planner: Finds the paths.
        timer: Puts times to the motions, if the world knows the limits of all joints.

    Raises:
        UsageError: The domain knows of no plan.
        LLM3Error: It is no sound plan in this world, such as with a robot that the domain did not think of.
        MissingCapability: The domain has no verifier.
    """
    domain = problem.domain
    actions = guarded(domain.witness, (tuple, type(None)), setting, seed)
    if actions is None:
        raise UsageError(f"domain {domain.name!r} knows no solution of setting {setting!r}, seed {seed}.")
    start = guarded(problem.env.reset, (State,))
    rolled = Roller(problem.env, planner, seed, perf_counter).rollout(start, actions)
    steps = timed(rolled.plan, timer, problem.env.joints) if timer else rolled.plan
    plan = plan_file(problem, start, steps)
    failed = next((outcome for outcome in rolled.outcomes if outcome.failure), None)
    reason = (
        f"{failed.action}: {failure_in_words(failed.failure)}" if failed and failed.failure else _fault(problem, plan)
    )
    if reason:
        known = f"the known solution of {domain.name}/{setting}, seed {seed},"
        raise LLM3Error(f"{known} does not solve this problem: {reason.removesuffix('.')}.")
    return plan


def _fault(problem: Problem, plan: PlanFile) -> str:
    """What is wrong with it at a second look; empty if it is sound."""
    found = verify(problem, plan)
    return "" if found.sound else str(found.defects[0])
