"""What is kept of each run of an experiment: one line of runs.jsonl."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field
from typing import Literal

from llm3.experiments.experiment import RunKey
from llm3.types import FrozenDict, Stats

Status = Literal["solved", "not solved", "error", "crashed"]
"""``error``: the program could not go on, as without an answer of a server; ``crashed``: a program has a mistake."""


@dataclass(frozen=True)
class RunLine:
    """What came of one run."""

    key: RunKey
    status: Status
    stop: str = ""
    """Why it ended, as `Result.stop` says; empty for a run that did not."""
    stats: Stats = field(default=Stats())
    iterations: int = 0
    """Proposals that were tried."""
    plan_length: int = 0
    """Actions of the plan that solves it."""
    failures: Mapping[str, int] = field(default_factory=FrozenDict)
    """How many iterations each kind of failure ended, by its value; those that only missed the goal are not here."""
    unmet: tuple[str, ...] = ()
    """What of the goal was missing at the end."""
    language_model: bool = False
    """Whether one was asked."""
    model: str = ""
    """The model as its server names it."""
    time_limited: bool = False
    """Whether a wall-clock guard cut something off, so that a second run may differ."""
    seconds: float = 0.0
    """From the first prompt to the end; making the world is not part of it."""
    error: str = ""
    traceback: str = ""

    def __post_init__(self) -> None:
        object.__setattr__(self, "failures", FrozenDict(self.failures))
        counts = {"iterations": self.iterations, "plan_length": self.plan_length, "seconds": self.seconds}
        counts |= {name: value for name, value in vars(self.stats).items() if name != "seconds"}
        for name, value in {**counts, **self.failures}.items():
            if value < 0:
                raise ValueError(f"{name} is {value:g}, and less than nothing cannot be")

    @property
    def solved(self) -> bool:
        """Whether a plan was found."""
        return self.status == "solved"

    @property
    def failed(self) -> bool:
        """Whether the program failed, which says nothing about the method."""
        return self.status in ("error", "crashed")
