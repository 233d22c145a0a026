"""Whole runs: the stand-in solves the settings, its plans are sound, and a world made of another one is as good."""

from __future__ import annotations

from contextlib import closing
from dataclasses import replace

import pytest

from llm3.assembly import RunConfig, assemble, prepare
from llm3.jsonio import dumps, loads
from llm3.records import PlanFile, open_plan
from llm3.records.plan import plan_file
from llm3.registry import Registry
from llm3.verification import verify
from llm3_blocks.settings import SMALL


@pytest.mark.slow
@pytest.mark.parametrize("setting", SMALL)
def test_the_stand_in_solves_seeds_0_to_9_and_every_plan_is_sound(solve, setting):
    registry = Registry.discover()
    for seed in range(10):
        result, plan = solve(setting=setting, seed=seed)
        assert result.solved, seed
        written = loads(dumps(plan), PlanFile, "the plan")
        with open_plan(registry, written) as problem:
            assert verify(problem, written).defects == ()


def test_the_largest_setting_is_solved(solve):
    assert solve(setting="blocks-6", seed=0)[0].solved


def test_a_cup_builds_towers_too(solve):
    assert solve(setting="blocks-3", seed=0, options={"robot": "iiwa"})[0].solved


def outcome(run) -> tuple[str, str]:
    result = run.solve()
    return dumps(replace(result, stats=replace(result.stats, seconds={}))), dumps(
        plan_file(run.problem, result.start, result.plan)
    )


def test_a_run_in_a_remade_world_leaves_the_same_bytes_as_one_in_a_new_world():
    registry = Registry.discover()
    first, second = RunConfig("blocks", "blocks-6", 1), RunConfig("blocks", "blocks-4", 7)
    with assemble(registry, second) as run:
        new = outcome(run)
    spare = prepare(registry, first).open()
    outcome(spare)
    run = prepare(registry, second).open(spare=spare.release())
    with closing(run):
        assert outcome(run) == new


def test_a_view_from_above_shows_the_blocks_from_the_lowest_to_the_highest(solve):
    from llm3_blocks.domain import Blocks

    domain = Blocks()
    result, _ = solve(setting="blocks-3", seed=0)
    shapes = domain.top_view(domain.instance("blocks-3", 0), {}, result.plan[-1].state)
    order = {on.block: on.below for on in domain.instance("blocks-3", 0).goal}
    names = [shape.name for shape in shapes]
    assert sorted(names) == sorted(order)
    assert all(below == "table" or names.index(below) < names.index(name) for name, below in order.items())
