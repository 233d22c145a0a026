"""How many runs are solved within a budget."""

from __future__ import annotations

from bisect import bisect_right
from collections.abc import Iterable, Sequence

from llm3.experiments import RunLine
from llm3.results.estimates import Estimate
from llm3.results.measures import VALUES
from llm3.results.proportions import share_estimate

UNITS = {"llm_calls": "model calls", "motion_calls": "motion calls", "tokens": "tokens", "seconds": "seconds"}
"""What there are budgets of, in words, by measure."""
OF_ANSWERS = ("llm_calls", "tokens")
"""Those that answers alone cost, of a model or of what stands in for one."""


def is_spent(runs: Iterable[RunLine], measure: str) -> bool:
    """Whether a budget of it means something to the method of these runs.

    To a search, which asks nobody, a budget of model calls or tokens means nothing. Nor does one of tokens where
    answers cost none: there is no language model, or its server does not count them.
    """
    if measure not in OF_ANSWERS:
        return True
    asked = [run for run in runs if run.language_model or run.stats.llm_calls]
    return bool(asked) and all(VALUES[measure](run) > 0 for run in asked if run.stats.llm_calls)


def shares_within(runs: Sequence[RunLine], measure: str, budgets: Iterable[float]) -> tuple[Estimate, ...]:
    """The share of runs that are solved within each budget; those that ended unsolved are so within none.

    Args:
        runs: Solved or not, at least one.
        measure: Of what the budgets are, a key of `UNITS`.
        budgets: In any order.
    """
    spent = sorted(VALUES[measure](run) for run in runs if run.solved)
    return tuple(share_estimate(bisect_right(spent, budget), len(runs)) for budget in budgets)


def curve(runs: Sequence[RunLine], measure: str, last: float) -> tuple[tuple[float, ...], tuple[Estimate, ...]]:
    """The budgets from 0 to the last at which the share of runs that are solved rises, and the share from there on.

    Args:
        runs: Solved or not, at least one.
        measure: Of what the budgets are, a key of `UNITS`.
        last: Where the curve ends; no run spent more.
    """
    budgets = tuple(sorted({0.0, *(VALUES[measure](run) for run in runs if run.solved), last}))
    return budgets, shares_within(runs, measure, budgets)
