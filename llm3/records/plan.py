"""plan.json: all that is needed to check a solution again, or to replay it, without a model."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from dataclasses import dataclass
from pathlib import Path
from typing import Any

from llm3.assembly import Problem, open_problem
from llm3.errors import InputError
from llm3.interfaces import Joint
from llm3.jsonio import dumps, loads, read_stated, to_builtins
from llm3.registry import Registry
from llm3.types import PlannedAction, State

PLAN_FORMAT = "llm3-plan/1"


@dataclass(frozen=True)
class PlanFile:
    """A solution on disk. It holds no date, folder or backend, so that equal runs give equal bytes.

    Lengths are in metres; joint values in the units of `joints`; poses in the world frame but for a grasp, which is
    the object's pose in the tool frame.
    """

    format: str
    domain: str
    instance: Any
    """The domain's instance as JSON."""
    options: Mapping[str, str]
    """The domain's options, all of them."""
    joints: tuple[Joint, ...]
    """What the numbers of a waypoint stand for."""
    start: State
    actions: tuple[PlannedAction, ...]
    """Each action, the segments that carry it out with the events between them, and the state it leads to."""

    def __post_init__(self) -> None:
        if self.format != PLAN_FORMAT:
            raise ValueError(f"the format is {self.format!r}, and this version reads {PLAN_FORMAT!r}")


def plan_file(problem: Problem, start: State, actions: tuple[PlannedAction, ...]) -> PlanFile:
    """A solution, as it goes to disk."""
    return PlanFile(
        PLAN_FORMAT,
        problem.domain.name,
        to_builtins(problem.instance),
        problem.options,
        problem.env.joints,
        start,
        actions,
    )


def read_plan(path: Path) -> PlanFile:
    """Read a plan from disk, or from a run's folder.

    Raises:
        InputError: There is none, or it does not have the documented form.
    """
    if path.is_dir():
        path = path / "plan.json"
        if not path.exists() and not path.with_name("run.json").exists():
            raise InputError(f"{path.parent} holds neither plan.json nor run.json: it is no folder of a run.")
        if not path.exists():
            raise InputError(f"{path.parent} holds no plan.json: the run was not solved, or has not ended.")
    return read_stated(path, PlanFile, PLAN_FORMAT)


def open_plan(registry: Registry, plan: PlanFile) -> Problem:
    """Make the world that a plan is for; the opposite of :func:`plan_file`.

    Raises:
        UnknownName: There is no such domain, or it has no such option.
        InputError: The instance is none of the domain's, or the plan is for another robot or does not fit itself.
    """
    domain = registry.domain(plan.domain)
    source = "the plan's instance"
    instance = loads(dumps(plan.instance), domain.instance_type, source)
    problem = open_problem(domain, instance, plan.options, source=source)
    try:
        _check_joints(plan, problem.env.joints)
    except BaseException:
        problem.env.close()
        raise
    return problem


def _check_joints(plan: PlanFile, joints: tuple[Joint, ...]) -> None:
    """See that all configurations are of this robot."""
    planned, there = (", ".join(f"{j.name} ({j.unit})" for j in side) or "none" for side in (plan.joints, joints))
    if planned != there:
        raise InputError(f"the plan is for a robot with the joints {planned}, but the robot has {there}.")
    count = len(plan.joints or plan.start.configuration)
    for owner, length in _lengths(plan):
        if length != count:
            raise InputError(f"the plan has {length} joint values in {owner}, and the robot needs {count}.")


def _lengths(plan: PlanFile) -> Iterator[tuple[str, int]]:
    """How many joint values each configuration has, and where it stands."""
    yield "the start", len(plan.start.configuration)
    for number, step in enumerate(plan.actions, start=1):
        for segment in step.motion.segments:
            owner = f"segment {segment.label!r} of action {number}"
            if not segment.waypoints:
                raise InputError(f"the plan has no waypoints in {owner}.")
            for row in (*segment.waypoints, *(segment.trajectory.positions if segment.trajectory else ())):
                yield owner, len(row)
        yield f"the state after action {number}", len(step.state.configuration)
