"""plan.json: all that is needed to check a solution again, or to replay it, without a model."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from pathlib import Path
from typing import Any

from llm3.assembly import Problem
from llm3.errors import InputError
from llm3.interfaces import Joint
from llm3.jsonio import read_file, to_builtins
from llm3.types import PlannedAction, Result, State

PLAN_FORMAT = "llm3-plan/1"


@dataclass(frozen=True)
class PlanFile:
    """A solution on disk. It holds no time, folder or backend, so that equal runs give equal bytes.

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


def plan_file(problem: Problem, result: Result) -> PlanFile:
    """The solution of a run, as it goes to disk."""
    return PlanFile(
        PLAN_FORMAT,
        problem.domain.name,
        to_builtins(problem.instance),
        problem.options,
        problem.env.joints,
        result.start,
        result.plan,
    )


def read_plan(path: Path) -> PlanFile:
    """Read a plan from disk, or from a run's folder.

    Raises:
        InputError: There is none, or it does not have the documented form.
    """
    if path.is_dir():
        path = path / "plan.json"
        if not path.exists():
            raise InputError(f"{path.parent} holds no plan.json: the run was not solved.")
    return read_file(path, PlanFile)
