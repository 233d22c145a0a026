"""What an experiment would be, in a few lines: for `llm3 experiment --dry-run`."""

from __future__ import annotations

from collections.abc import Iterator
from pathlib import Path

from llm3.experiments import Experiment, Share
from llm3.wording import counted


def preview(experiment: Experiment, shares: tuple[Share, ...], folder: Path) -> Iterator[str]:
    """A line for the whole, one for each method, and one for the bill.

    Args:
        experiment: What is asked.
        shares: What is still to be done, by method.
        folder: Where the runs go.
    """
    yield (
        f"{experiment.name}: {counted(len(experiment), 'run')}, of {counted(len(experiment.methods), 'method')} on "
        f"{counted(len(experiment.problems), 'problem')} with {counted(len(experiment.seeds), 'seed')}"
    )
    missing = sum(share.runs for share in shares)
    if missing < len(experiment):
        yield f"{counted(len(experiment) - missing, 'run')} ended before in {folder}, and {missing:,} are missing"
    width = max((len(share.method) for share in shares), default=0)
    for share in shares:
        yield f"  {share.method:<{width}}  {counted(share.runs, 'run'):>10}, {_at_most(share)}"
    calls = sum(share.calls for share in shares if share.language_model)
    yield f"at most {counted(calls, 'call')} of a language model"


def _at_most(share: Share) -> str:
    if not share.calls:
        return f"at most {counted(share.motion_calls, 'motion call')} of the solver {share.asked}"
    if share.language_model:
        return f"at most {counted(share.calls, 'call')} of {share.asked}"
    return f"at most {counted(share.calls, 'proposal')} of {share.asked}, which is no language model"
