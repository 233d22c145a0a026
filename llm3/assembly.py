"""From the names that a user gives to a run that is ready to start."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field, replace
from math import inf
from types import TracebackType
from typing import Any

from threadpoolctl import threadpool_limits

from llm3.errors import MissingCapability, MissingDependency, UnknownName, UsageError
from llm3.guarded import guarded
from llm3.interfaces import (
    BackendSettings,
    Domain,
    Env,
    FeedbackSynthesizer,
    LLMBackend,
    MotionPlanner,
    Options,
    PlannerSettings,
    Strategy,
    TrajectoryTimer,
)
from llm3.prompts import Prompt
from llm3.registry import Registry
from llm3.solve import Budget, solve
from llm3.types import FrozenDict, Observer, Result, Sketch, nobody

USUAL_TIMER = "toppra"
UNTIMED = "none"
"""The name that means no timer."""


@dataclass(frozen=True)
class RunConfig:
    """What a user asks for, JSON-safe; every default is the command line's."""

    domain: str
    setting: str | None = None
    """None: the domain's default setting."""
    seed: int = 0
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
    """No call is made after so long, and none takes longer; None for no limit."""
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

    @property
    def budget(self) -> Budget:
        """What the run may spend."""
        return Budget(self.max_llm_calls, self.trace_size, self.max_tokens_total, self.max_seconds)

    @property
    def backend(self) -> str:
        """The backend that is meant: ``http`` for a model, ``offline`` without one."""
        return self.llm or ("offline" if self.model is None else "http")

    @property
    def run_name(self) -> str:
        """The problem and the method, such as ``boxpack/hard-small/0/backtrack/categorized``."""
        setting = "instance" if self.setting is None else self.setting
        return f"{self.domain}/{setting}/{self.seed}/{self.strategy}/{self.feedback}"


@dataclass(frozen=True)
class Problem:
    """A domain's instance, its options, and the world made from them. Close it, or use it in a ``with``."""

    domain: Domain
    instance: Any
    options: Options
    env: Env

    def __enter__(self) -> Problem:
        return self

    def __exit__(
        self, kind: type[BaseException] | None, error: BaseException | None, traceback: TracebackType | None
    ) -> None:
        self.env.close()


@dataclass(frozen=True)
class Run:
    """Everything that :func:`llm3.solve` needs, made from a RunConfig. Close it, or use it in a ``with``."""

    config: RunConfig
    problem: Problem
    skeleton: tuple[Sketch, ...]
    prompt: Prompt
    backend: LLMBackend
    planner: MotionPlanner
    feedback: FeedbackSynthesizer
    timer: TrajectoryTimer | None = None

    def solve(self, observer: Observer = nobody) -> Result:
        """Run it; see :func:`llm3.solve`.

        numpy's linear algebra works on one thread meanwhile: the matrices here are small, so that more threads make it
        several times slower, and the last bits of a sum would depend on their number.
        """
        with threadpool_limits(1, user_api="blas"):
            return self._solve(observer)

    def _solve(self, observer: Observer) -> Result:
        config = self.config
        return solve(
            self.problem.env,
            backend=self.backend,
            planner=self.planner,
            feedback=self.feedback,
            prompt=self.prompt,
            timer=self.timer,
            skeleton=self.skeleton,
            budget=config.budget,
            seed=config.seed,
            observer=observer,
        )

    def close(self) -> None:
        """Let go of the world and the backend. Calling it twice does no harm."""
        try:
            self.backend.close()
        finally:
            self.problem.env.close()

    def __enter__(self) -> Run:
        return self

    def __exit__(
        self, kind: type[BaseException] | None, error: BaseException | None, traceback: TracebackType | None
    ) -> None:
        self.close()


def choose_instance(domain: Domain, setting: str | None, seed: int) -> Any:
    """The instance of a setting, or of the default one, and a seed.

    Raises:
        UnknownName: The domain has no such setting.
    """
    setting = domain.default_setting if setting is None else setting
    if setting not in domain.settings:
        raise UnknownName("setting", setting, domain.settings, owner=f"domain {domain.name!r}")
    return guarded(domain.instance, (domain.instance_type,), setting, seed)


def choose_options(domain: Domain, given: Mapping[str, str]) -> Options:
    """A value for every option of the domain.

    Raises:
        UnknownName: The domain has no such option, or the option no such value.
    """
    known = {option.name: option for option in domain.options}
    for name, value in given.items():
        if name not in known:
            raise UnknownName("option", name, known, owner=f"domain {domain.name!r}")
        choices = known[name].choices
        if choices and value not in choices:
            raise UnknownName("value", value, choices, owner=f"option {name!r}")
    return FrozenDict({name: given.get(name, option.default) for name, option in known.items()})


def open_problem(domain: Domain, instance: Any, options: Mapping[str, str], window: bool = False) -> Problem:
    """Make the world of an instance, and show it in a window if asked.

    Its options are those that a record keeps: `Domain.self_contained`.

    Raises:
        UnknownName: The domain has no such option.
        MissingCapability: The domain has no window.
    """
    chosen = FrozenDict(guarded(domain.self_contained, (Mapping,), choose_options(domain, options)))
    make = domain.make_in_window if window else domain.make
    env = guarded(make, (Env, type(None)) if window else (Env,), instance, chosen)
    if env is None:
        raise MissingCapability(domain.name, "window", "--gui")
    return Problem(domain, instance, chosen, env)


def given_skeleton(domain: Domain, instance: Any, strategy: Strategy, name: str) -> tuple[Sketch, ...]:
    """The action sequence that a prompt of this strategy shows; empty where the model writes its own.

    Raises:
        MissingCapability: The strategy needs one, and the domain has none.
    """
    if not strategy.fixed_sequence:
        return ()
    skeleton = domain.skeleton(instance)
    if not skeleton:
        raise MissingCapability(domain.name, "skeleton", f"strategy {name!r}")
    return skeleton


def choose_timer(registry: Registry, name: str | None) -> TrajectoryTimer | None:
    """The timer of this name; for None the usual one if it can be had.

    Raises:
        UnknownName: There is none of this name.
        MissingDependency: It needs a package that is not installed.
    """
    if name == UNTIMED:
        return None
    if name is not None:
        try:
            return registry.timer(name)
        except UnknownName as error:
            raise UnknownName("timer", name, (*error.known, UNTIMED), remark=error.remark) from None
    try:
        return registry.timer(USUAL_TIMER)
    except (UnknownName, MissingDependency):
        return None


def assemble(registry: Registry, config: RunConfig, instance: Any = None, window: bool = False) -> Run:
    """Make everything that a run needs.

    Args:
        registry: Where the names are looked up.
        config: What the user asks for.
        instance: The problem, where it does not come from setting and seed.
        window: Whether to show the world in the domain's window.

    Raises:
        LLM3Error: A name is unknown, or the domain lacks what the strategy or the backend needs.
    """
    domain = registry.domain(config.domain)
    strategy = registry.strategy(config.strategy)
    feedback = registry.feedback(config.feedback)
    planner = registry.planner(config.planner, PlannerSettings(config.planner_iterations, config.planner_seconds))
    timer = choose_timer(registry, config.timing)
    prompt = Prompt(strategy)
    if instance is None:
        instance = choose_instance(domain, config.setting, config.seed)
        config = replace(config, setting=domain.default_setting if config.setting is None else config.setting)
    skeleton = given_skeleton(domain, instance, strategy, config.strategy)
    timing = UNTIMED if timer is None else config.timing or USUAL_TIMER
    config = replace(config, llm=config.backend, timing=timing)
    name, _, argument = config.backend.partition(":")
    backend = registry.backend(
        name,
        BackendSettings(
            domain=domain.name,
            argument=argument or None,
            model=config.model,
            temperature=config.temperature,
            max_reply_tokens=config.max_reply_tokens,
            stand_in=domain.stand_in(),
            skeleton=domain.skeleton(instance) or (),
            regions=domain.regions(instance) or FrozenDict(),
            run=config.run_name,
        ),
    )
    config = replace(config, **backend.recorded)
    try:
        problem = open_problem(domain, instance, config.options, window)
    except BaseException:
        backend.close()
        raise
    return Run(config, problem, skeleton, prompt, backend, planner, feedback, timer)
