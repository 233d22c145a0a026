"""Forty motion queries, one planner beside another; the table at the end is Markdown.

    OMP_NUM_THREADS=1 OPENBLAS_NUM_THREADS=1 python -m pytest -q tests/benchmarks/test_queries.py

Every planner answers all queries with a seed before the next seed has its turn, so that a busy spell of the machine
hits all of them alike. Nothing is asserted: times belong to a machine.
"""

from __future__ import annotations

import sys
from collections.abc import Iterator
from contextlib import ExitStack

import pytest
from planners import PLANNERS, Solve
from queries import queries
from query_table import Comparison, markdown

from llm3_bullet.robots.panda import panda
from llm3_bullet.workcell import Workcell

SEEDS = range(3)


@pytest.fixture(scope="module")
def cell() -> Iterator[Workcell]:
    cell = Workcell(panda())
    yield cell
    cell.close()


@pytest.fixture(scope="module")
def comparison(cell: Workcell, request: pytest.FixtureRequest) -> Iterator[Comparison]:
    """Collects what was measured, and writes the table at the end."""
    comparison = Comparison(queries(), cell)
    yield comparison
    with request.config.pluginmanager.getplugin("capturemanager").global_and_fixture_disabled():
        sys.stdout.write(f"\n\n{markdown(comparison)}\n")


@pytest.mark.parametrize("name", PLANNERS)
@pytest.mark.parametrize("seed", SEEDS)
def test_planner(benchmark, cell: Workcell, comparison: Comparison, name: str, seed: int) -> None:
    chosen = comparison.queries.chosen
    waiting, answers = iter(chosen), []

    with ExitStack() as stack:

        def next_query() -> tuple[tuple[Solve], dict[str, object]]:
            stack.close()
            return (stack.enter_context(PLANNERS[name](next(waiting), cell)),), {}

        def answer(solve: Solve) -> None:
            answers.append(solve(seed))

        benchmark.pedantic(answer, setup=next_query, rounds=len(chosen))
    comparison.add(name, benchmark.stats.stats.data, answers)
