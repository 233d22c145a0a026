"""What a user asks for."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field
from math import inf

from llm3.budget import Budget
from llm3.errors import UnknownName, UsageError
from llm3.interfaces import PlannerSettings
from llm3.types import FrozenDict

USUAL_TIMER = "toppra"
UNTIMED = "none"
"""The name that means no timer."""
LOOP, SEARCH = "loop", "search"
"""The names of the solvers: the paper's loop with a model, and a search without one."""
OF_A_MODEL = ("llm", "model", "temperature", "max_reply_tokens", "max_tokens_total")
"""What has no meaning for a solver that asks no model."""


@dataclass(frozen=True)
class RunConfig:
    """What a user asks for, JSON-safe; every default is the command line's."""

    domain: str
    setting: str | None = None
    """None: the domain's default setting."""
    seed: int = 0
    solver: str = LOOP
    """`loop`, or `search`, which asks no model: what is said of models, prompts and feedback means nothing to it."""
    strategy: str = "backtrack"
    feedback: str = "categorized"
    llm: str | None = None
    """A backend, with an argument after a colon where it takes one; None leaves the choice to `backend`."""
    model: str | None = None
    temperature: float | None = None
    planner: str = "birrt"
    planner_iterations: int = 2000
    """What the planner may spend on one query."""
    planner_seconds: float = 30.0
    """A guard on one query, not the budget: a run that hits it is marked, and may not repeat."""
    timing: str | None = None
    """What puts times to the plan's motions, or `none`; None is the usual timer where it is installed, else `none`."""
    max_llm_calls: int = 20
    trace_size: int = 5
    max_reply_tokens: int | None = None
    """What the model may write in one reply; None leaves it to the model, or to what its server demands."""
    max_tokens_total: int | None = None
    """No call is made once so many tokens were read and written; None for no limit."""
    max_seconds: float | None = None
    """No call is made after so long, and none takes longer; None for no limit. A search tries no plan after it."""
    max_motion_calls: int | None = None
    """No plan is tried once so many motion calls were made; None for no limit, or what a search needs to end."""
    options: Mapping[str, str] = field(default_factory=FrozenDict)
    """Domain options that differ from their defaults."""

    def __post_init__(self) -> None:
        object.__setattr__(self, "options", FrozenDict(self.options))
        self.budget  # noqa: B018  # refuses what cannot be
        PlannerSettings(self.planner_iterations, self.planner_seconds)
        if self.temperature is not None and not 0 <= self.temperature < inf:
            raise UsageError(f"the temperature must be 0 or more, not {self.temperature:g}.")
        if self.model is not None and not self.model.strip():
            raise UsageError("the model's name is empty: name one, or leave out --model.")
        if self.max_reply_tokens is not None and self.max_reply_tokens < 1:
            raise UsageError(f"the tokens of a reply must be at least 1, not {self.max_reply_tokens}.")
        if self.solver not in (LOOP, SEARCH):
            raise UnknownName("solver", self.solver, (LOOP, SEARCH))
        for name in OF_A_MODEL:
            if self.is_search and getattr(self, name) is not None:
                raise UsageError(f"the solver {SEARCH!r} asks no model: leave out --{name.replace('_', '-')}.")

    @property
    def is_search(self) -> bool:
        """Whether the problem is searched, without a model."""
        return self.solver == SEARCH

    @property
    def budget(self) -> Budget:
        """What the run may spend."""
        return Budget(
            self.max_llm_calls, self.trace_size, self.max_tokens_total, self.max_seconds, self.max_motion_calls
        )

    @property
    def backend(self) -> str:
        """The backend that is meant: ``http`` for a model, ``offline`` without one."""
        return self.llm or ("offline" if self.model is None else "http")

    @property
    def run_name(self) -> str:
        """The problem and the method, such as ``boxpack/hard-small/0/backtrack/categorized`` or ``…/0/search``."""
        setting = "instance" if self.setting is None else self.setting
        method = SEARCH if self.is_search else f"{self.strategy}/{self.feedback}"
        return f"{self.domain}/{setting}/{self.seed}/{method}"
