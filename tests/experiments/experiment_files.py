"""Experiments on the corridor, which is quick: random parameters, and a script of replies."""

from __future__ import annotations

import json
from collections.abc import Callable
from concurrent.futures import Executor, Future
from pathlib import Path
from typing import Any

from llm3.experiments import Experiment, ExperimentWriter, RunLine, experiment_of, missing_jobs, run_experiment
from llm3.experiments.work import Worker
from llm3.registry import Registry

CORRIDOR: dict[str, Any] = {
    "name": "walks",
    "title": "Two ways down a corridor",
    "attempts": 3,
    "problems": [{"domain": "corridor", "setting": "default"}],
    "methods": [
        {"name": "random", "llm": "random", "strategy": "sample-params", "feedback": "none", "max_llm_calls": 30},
        {
            "name": "one random try",
            "llm": "random",
            "strategy": "sample-params",
            "feedback": "none",
            "max_llm_calls": 1,
        },
    ],
}
TOML = """
name = "walks"
title = "Two ways down a corridor"
attempts = 3

[[problems]]
domain = "corridor"
setting = "default"

[[methods]]
name = "random"
llm = "random"
strategy = "sample-params"
feedback = "none"
max_llm_calls = 30

[[methods]]
name = "one random try"
llm = "random"
strategy = "sample-params"
feedback = "none"
max_llm_calls = 1
"""


def experiment(**changes: Any) -> Experiment:
    """The experiment of `CORRIDOR` with other fields."""
    return experiment_of({**CORRIDOR, **changes}, "walks.toml")


class Here(Executor):
    """Does everything at once, in this thread."""

    def submit(self, fn: Callable[..., Any], /, *args: Any, **kwargs: Any) -> Future[Any]:
        """Do it."""
        future: Future[Any] = Future()
        try:
            future.set_result(fn(*args, **kwargs))
        except Exception as error:
            future.set_exception(error)
        return future


def carry_out(
    folder: Path,
    asked: Experiment,
    executor: Executor | None = None,
    retry: bool = False,
    slots: int = 1,
    **options: Any,
) -> list[RunLine]:
    """Run what is missing in a folder; the lines that were added."""
    seen: list[RunLine] = []
    work = Worker(Registry.discover()).work  # of its own, so that it knows the plugins of this test
    part = options.pop("part", asked)
    with ExperimentWriter(folder, asked, {"llm3": "1"}) as writer:
        jobs = missing_jobs(part, writer.ended, retry)
        run_experiment(
            jobs,
            writer,
            executor or Here(),
            slots,
            limits=options.pop("limits", {}),
            records=options.pop("records", False),
            watcher=seen.append,
            **({"work": work} if executor is None or isinstance(executor, Here) else {}),
        )
    return seen


def lines_of(folder: Path) -> list[dict[str, Any]]:
    """The lines of runs.jsonl after its header, as they stand there."""
    _, *lines = (folder / "runs.jsonl").read_text(encoding="utf-8").splitlines()
    return [json.loads(line) for line in lines]


def without_times(lines: list[dict[str, Any]]) -> list[str]:
    """What two runs of one experiment have in common: all but seconds, in any order."""
    kept = [{**line, "seconds": None, "stats": {**line["stats"], "seconds": None}} for line in lines]
    return sorted(json.dumps(line, sort_keys=True) for line in kept)
