"""Carries out a plan, and holds what came of it against what it promised."""

from __future__ import annotations

from collections.abc import Iterator
from contextlib import contextmanager
from math import asin, dist

import numpy as np

from llm3.assembly import Problem
from llm3.errors import InputError, MissingCapability, PluginError
from llm3.guarded import guarded
from llm3.interfaces import Executor
from llm3.records import PlanFile
from llm3.types import Execution, ExecutionReport, GoalStatus, Noise, Pose, PoseError, State
from llm3.verification import differences, fault


@contextmanager
def open_executor(problem: Problem, noise: Noise) -> Iterator[Executor]:
    """The executor of a problem's domain, which is closed after the block.

    Args:
        problem: What plans are for.
        noise: By how much a simulated world differs from them.

    Raises:
        MissingCapability: The domain has none.
        UsageError: It takes no noise.
        PluginError: The domain failed.
    """
    domain = problem.domain
    executor = guarded(domain.executor, (Executor, type(None)), problem.instance, problem.options, noise)
    if executor is None:
        raise MissingCapability(domain.name, "executor", "'llm3 execute'")
    try:
        yield executor
    finally:
        guarded(executor.close, (type(None),))


def execute(problem: Problem, plan: PlanFile, executor: Executor, rng: np.random.Generator) -> ExecutionReport:
    """Carry out a plan.

    Args:
        problem: What the plan is for; see :func:`llm3.records.open_plan`.
        plan: The plan.
        executor: What carries it out; see `open_executor`.
        rng: What chance decides.

    Raises:
        InputError: The plan starts elsewhere than the problem, or makes no sense for it.
        PluginError: The executor failed.
    """
    for difference in differences(plan.start, guarded(problem.env.reset, (State,))):
        raise InputError(f"the plan does not start where the problem does: {difference}.")
    for number, step in enumerate(plan.actions, start=1):
        reason = fault(problem.env, step.action)
        if reason:
            raise InputError(f"action {number} {step.action}: {reason}.")
    done = guarded(executor.execute, (Execution,), plan.start, plan.actions, rng)
    if len(done.actions) != len(plan.actions):
        owner, wanted = type(executor).__name__, len(plan.actions)
        raise PluginError(f"{owner}.execute must tell of all {wanted} actions of the plan, not of {len(done.actions)}.")
    goal = guarded(problem.env.goal, (GoalStatus,), done.state)
    meant = plan.actions[-1].state if plan.actions else plan.start
    return ExecutionReport(done, goal, dict(_errors(done.state, meant)))


def _errors(state: State, meant: State) -> Iterator[tuple[str, PoseError]]:
    for name, pose in state.poses.items():
        if name in meant.poses:
            yield name, _error(pose, meant.poses[name])


def _error(one: Pose, other: Pose) -> PoseError:
    a, b = np.array(one.orientation), np.array(other.orientation)
    apart = min(float(np.linalg.norm(a - b)), float(np.linalg.norm(a + b)))  # opposite quaternions are the same turn
    return PoseError(dist(one.position, other.position), 4 * asin(min(1.0, apart / 2)))
