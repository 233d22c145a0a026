"""The same seed and the same replies give the same plan.json, byte for byte."""

from __future__ import annotations

import os
import subprocess
import sys
from collections.abc import Iterator
from pathlib import Path

import pytest

from llm3.assembly import RunConfig, assemble
from llm3.records import Recorder
from llm3.registry import Registry

CONFIG = RunConfig("boxpack", setting="hard-small", seed=2)
RUN = """\
import sys
sys.path[:0] = {path!r}
from pathlib import Path
from llm3.assembly import RunConfig, assemble
from llm3.records import Recorder
from llm3.registry import Registry
with assemble(Registry.discover(), RunConfig("boxpack", setting="hard-small", seed=2)) as run:
    with Recorder(Path({folder!r}), run) as record:
        run.solve(record)
"""


def plan_here(folder: Path) -> bytes:
    with assemble(Registry.discover(), CONFIG) as run, Recorder(folder, run) as record:
        assert run.solve(record).solved
    return (folder / "plan.json").read_bytes()


@pytest.fixture
def busy() -> Iterator[None]:
    """Another process that takes all the time that it can get."""
    process = subprocess.Popen([sys.executable, "-c", "while True: pass"])
    yield
    process.kill()
    process.wait()


@pytest.fixture(scope="module")
def expected(tmp_path_factory) -> bytes:
    return plan_here(tmp_path_factory.mktemp("first"))


def test_a_second_run_in_the_same_process_writes_the_same_plan(expected, tmp_path):
    assert plan_here(tmp_path) == expected


@pytest.mark.parametrize("hash_seed", ["0", "4242"])
def test_another_process_beside_a_busy_one_writes_the_same_plan(expected, tmp_path, busy, hash_seed):
    code = RUN.format(path=sys.path, folder=str(tmp_path))
    surroundings = {**os.environ, "PYTHONHASHSEED": hash_seed}
    subprocess.run([sys.executable, "-c", code], env=surroundings, check=True, capture_output=True, cwd=tmp_path)
    assert (tmp_path / "plan.json").read_bytes() == expected


def test_another_seed_writes_another_plan(expected, solve):
    result, plan = solve(setting="hard-small", seed=3)
    assert result.solved
    assert plan.start.poses != {}
    assert str(plan.actions[1].action) not in expected.decode()
