from __future__ import annotations

from collections.abc import Callable, Iterator

import pytest

from llm3.assembly import RunConfig, assemble
from llm3.records import PlanFile
from llm3.records.plan import plan_file
from llm3.registry import Registry
from llm3.types import Defect, Result
from llm3.verification import verify
from llm3_bullet.robots.panda import panda
from llm3_bullet.workcell import Workcell
from llm3_kitchen.env import KitchenEnv
from llm3_kitchen.instance import KitchenInstance

Make = Callable[[KitchenInstance], KitchenEnv]
Solve = Callable[..., tuple[Result, PlanFile, tuple[Defect, ...]]]


@pytest.fixture(scope="session")
def make() -> Iterator[Make]:
    """An Env for an instance, around one robot for all of them."""
    cell = Workcell(panda())
    yield lambda instance: KitchenEnv(instance, cell)
    cell.close()


@pytest.fixture(scope="session")
def solve() -> Solve:
    """A run of the whole loop, as the command line makes it, the plan on disk, and what a second look finds in it."""
    registry = Registry.discover()

    def run(**config: object) -> tuple[Result, PlanFile, tuple[Defect, ...]]:
        with assemble(registry, RunConfig("kitchen", timing="none", **config)) as ready:  # type: ignore[arg-type]  # any field
            result = ready.solve()
            plan = plan_file(ready.problem, result.start, result.plan)
            return result, plan, verify(ready.problem, plan).defects

    return run
