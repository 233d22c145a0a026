"""Nothing piles up, however long a process plans."""

from __future__ import annotations

import gc
from itertools import islice
from pathlib import Path

import numpy as np
import pytest
from packing_world import carried_out, pick, place

from llm3_boxpack.env import BoxpackEnv
from llm3_boxpack.paper_settings import SETTINGS, generate
from llm3_bullet.robots import panda
from llm3_bullet.workcell import Workcell

ALLOWED = 8.0
"""Megabytes; a leak of a kilobyte a reset, or ten an action, would be more."""


def resident() -> float:
    """Megabytes of memory that this process holds."""
    gc.collect()
    pages = int(Path("/proc/self/statm").read_text(encoding="ascii").split()[1])
    return pages * 4096 / 2**20


@pytest.fixture(scope="module")
def cell():
    shared = Workcell(panda())
    yield shared
    shared.close()


def growth(work, warm_up: int, count: int) -> float:
    """Megabytes that so many pieces of work add, once some were done."""
    for _ in islice(work, warm_up):
        pass
    before = resident()
    for _ in islice(work, count):
        pass
    return resident() - before


@pytest.mark.slow
def test_ten_thousand_resets_leave_memory_as_it_was(cell):
    def work():
        seed = 0
        while True:
            for setting in SETTINGS:
                env = BoxpackEnv(generate(setting, seed), cell)
                cell.checker.view(env.scene(env.reset())).valid(cell.model.home[None])
                yield
            seed += 1

    assert growth(work(), 1000, 10_000) < ALLOWED


@pytest.mark.slow
def test_a_thousand_planned_actions_leave_memory_as_it_was(cell):
    def work():
        rng = np.random.default_rng(0)
        env = BoxpackEnv(generate("medium-small", 0), cell)
        start = env.reset()
        while True:
            name = str(rng.choice(env.objects))
            picked = carried_out(env, start, pick(name), int(rng.integers(1000)))[1].state
            yield
            x, y, theta = rng.uniform((0.56, -0.08, -3.0), (0.74, 0.08, 3.0))
            carried_out(env, picked, place(name, round(x, 3), round(y, 3), round(theta, 3)))
            yield

    assert growth(work(), 200, 1000) < ALLOWED
