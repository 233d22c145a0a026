"""What is measured of a run."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Mapping

import numpy as np
from numpy.typing import NDArray

from llm3.experiments import RunLine

VALUES: Mapping[str, Callable[[RunLine], float]] = {
    "success": lambda run: run.solved,
    "llm_calls": lambda run: run.stats.llm_calls,
    "motion_calls": lambda run: run.stats.motion_calls,
    "motion_calls_with_reused": lambda run: run.stats.motion_calls + run.stats.reused_actions,
    "iterations": lambda run: run.iterations,
    "tokens": lambda run: run.stats.tokens,
    "seconds": lambda run: run.seconds,
}
"""The value of each of the `MEASURES` of an experiment for one run."""
MACHINE = frozenset({"seconds"})
"""Those that another machine, or another hour, would change."""


def is_attempt(run: RunLine) -> bool:
    """Whether the method had its try: a run that ended in an error or crashed says nothing of it."""
    return run.status in ("solved", "not solved")


def without_model(runs: Iterable[RunLine]) -> bool:
    """Whether a language model was asked in none of them."""
    return not any(run.language_model for run in runs)


def is_known(runs: Iterable[RunLine], measure: str) -> bool:
    """Whether a measure is known of all of them: not every server counts its tokens."""
    uncounted = (run.language_model and run.stats.llm_calls and not run.stats.tokens for run in runs)
    return measure != "tokens" or not any(uncounted)


def values(runs: Iterable[RunLine], measures: Iterable[str]) -> NDArray[np.float64]:
    """(runs, measures)."""
    wanted = [VALUES[measure] for measure in measures]
    return np.array([[value(run) for value in wanted] for run in runs], float).reshape(-1, len(wanted))
