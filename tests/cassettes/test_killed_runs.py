"""A run that is killed leaves what had happened: readable, and repeatable so far."""

from __future__ import annotations

import json
import subprocess
import time
from collections.abc import Callable
from pathlib import Path

import numpy as np
import pytest
from command_line import llm3
from corridor_replies import reply

from llm3.records import read_cassette, read_events, read_exchanges
from llm3.types import ReplyReceived

ATTEMPTS = 300
FLAGS = f"--domain corridor --seed 7 --trace-size 1 --max-llm-calls {ATTEMPTS} --quiet"
RANDOM = np.random.default_rng(4).integers(1, 200_000, size=10)
MOMENTS = [0, RANDOM[0], *(pytest.param(size, marks=pytest.mark.slow) for size in RANDOM[1:])]
"""How many bytes of events there are, at least, when the run is killed."""


def killed(cwd: Path, surroundings: dict[str, str], when: Callable[[], bool]) -> None:
    """Start a run that tries many plans, and kill it at some moment."""
    plans = [reply(f"go([], {{'x': {0.2 + n / 1000}, 'y': 0.5}})") for n in range(ATTEMPTS)]
    (cwd / "replies.json").write_text(json.dumps(plans), encoding="utf-8")
    line = f"{FLAGS} --llm scripted:replies.json --out first --record tape.jsonl"
    process = subprocess.Popen(llm3(line), cwd=cwd, env=surroundings)
    try:
        while not when():
            assert process.poll() is None
            time.sleep(0.001)
    finally:
        process.kill()
    assert process.wait(timeout=60) == -9


@pytest.mark.parametrize("size", MOMENTS)
def test_a_killed_run_is_readable_and_repeats_that_far(command, cwd, surroundings, size):
    events = cwd / "first/events.jsonl"
    killed(cwd, surroundings, lambda: (cwd / "first/run.json").exists() and events.stat().st_size >= size)
    told = [recorded.event for recorded in read_events(cwd / "first")]
    exchanges, tape = list(read_exchanges(cwd / "first")), list(read_cassette(cwd / "tape.jsonl"))
    replies = [event.completion.text for event in told if isinstance(event, ReplyReceived)]
    assert [exchange.completion.text for exchange in exchanges] == replies
    assert [e.digest for e in tape] == [e.digest for e in exchanges][: len(tape)]
    assert len(tape) in (len(exchanges), len(exchanges) - 1)  # the record is written first

    count = f"{len(exchanges)} prompt{'s' * (len(exchanges) != 1)}"
    ended = command("--llm replay:first --out again --quiet")
    assert (ended.code, ended.out) == (3, "")
    assert ended.err == f"llm3: error: the recording 'first' ends after {count}: its run was cut off.\n"
    assert [e.digest for e in read_exchanges(cwd / "again")][:-1] == [e.digest for e in exchanges]

    ended = command(f"{FLAGS} --llm replay:tape.jsonl --out from-tape")
    assert ended.code == 3
    assert [e.digest for e in read_exchanges(cwd / "from-tape")][:-1] == [e.digest for e in tape]
