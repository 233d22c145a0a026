from __future__ import annotations

from collections.abc import Callable

import pytest
from in_process import command, cwd, plugins

from llm3.assembly import RunConfig, assemble
from llm3.records import PlanFile
from llm3.records.plan import plan_file
from llm3.registry import Registry
from llm3.types import Result, Verification
from llm3.verification import verify

__all__ = ["command", "cwd", "plugins"]

Solve = Callable[..., tuple[Result, PlanFile, Verification | None]]


@pytest.fixture(scope="session")
def solve() -> Solve:
    """A run as the command line makes it, the plan that it leaves on disk, and a second look at it if it is solved."""
    registry = Registry.discover()

    def run(**config: object) -> tuple[Result, PlanFile, Verification | None]:
        with assemble(registry, RunConfig("tabletop2d", **config)) as ready:  # type: ignore[arg-type]  # any field
            result = ready.solve()
            plan = plan_file(ready.problem, result.start, result.plan)
            return result, plan, verify(ready.problem, plan) if result.solved else None

    return run
