from __future__ import annotations

from collections.abc import Callable, Iterator

import pytest

from llm3.assembly import RunConfig, assemble
from llm3.records import PlanFile
from llm3.records.plan import plan_file
from llm3.registry import Registry
from llm3.types import Result
from llm3_blocks.env import BlocksEnv
from llm3_blocks.instance import BlocksInstance
from llm3_bullet.robots.panda import panda
from llm3_bullet.workcell import Workcell

Make = Callable[[BlocksInstance], BlocksEnv]
Solve = Callable[..., tuple[Result, PlanFile]]


@pytest.fixture(scope="session")
def workcell() -> Iterator[Workcell]:
    """One robot for many problems."""
    cell = Workcell(panda())
    yield cell
    cell.close()


@pytest.fixture(scope="session")
def make(workcell: Workcell) -> Make:
    """An Env for an instance."""
    return lambda instance: BlocksEnv(instance, workcell)


@pytest.fixture(scope="session")
def solve() -> Solve:
    """A run of the whole loop, as the command line makes it, and the plan that it leaves on disk."""
    registry = Registry.discover()

    def run(**config: object) -> tuple[Result, PlanFile]:
        with assemble(registry, RunConfig("blocks", **config)) as ready:  # type: ignore[arg-type]  # any field
            result = ready.solve()
            return result, plan_file(ready.problem, result.start, result.plan)

    return run
