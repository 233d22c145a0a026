"""From names to a run, in two steps: look everything up, then make the world."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, replace
from types import TracebackType
from typing import Any

from llm3.assembly.choices import choose_instance, choose_timer, given_skeleton, settle_options
from llm3.assembly.config import UNTIMED, USUAL_TIMER, RunConfig
from llm3.assembly.problem import Problem, open_world
from llm3.assembly.run import Run
from llm3.assembly.solvers import Loop, Search, Solver
from llm3.interfaces import (
    BackendSettings,
    Domain,
    Env,
    LLMBackend,
    MotionPlanner,
    Options,
    PlannerSettings,
    TrajectoryTimer,
)
from llm3.prompts import Prompt
from llm3.registry import Registry
from llm3.search import MOTION_CALLS
from llm3.types import FrozenDict


@dataclass(frozen=True)
class Prepared:
    """A run without its world: all names are looked up, and nothing heavy is loaded.

    Open it once, or close it, or use it in a ``with``.
    """

    config: RunConfig
    """What the user asked for, with what was chosen for whatever was left open."""
    domain: Domain
    instance: Any
    options: Options
    solver: Solver
    planner: MotionPlanner
    timer: TrajectoryTimer | None
    plugins: Mapping[str, str]
    """Where each plugin that the run uses comes from, such as ``"planner/birrt": "birrt (llm3 0.1.0)"``."""
    source: str = ""
    """Where the instance comes from, such as its file, for messages about it."""

    @property
    def language_model(self) -> bool:
        """Whether a language model will be asked."""
        return self.solver.language_model

    @property
    def notice(self) -> str:
        """One line that the user should read before the run, or nothing."""
        return self.solver.notice

    def open(self, spare: Env | None = None) -> Run:
        """Make the world. The run has what was prepared from now on, and closes it.

        Args:
            spare: A world of such a domain that is no longer needed, see `Run.release`: it is used up, either by
                `Domain.remake`, which is quicker than a new world, or by being closed.

        Raises:
            LLM3Error: The world cannot be made; then all is closed.
        """
        try:
            env = open_world(self.domain, self.instance, self.options, spare, self.source)
        except BaseException:
            self.close()
            raise
        problem = Problem(self.domain, self.instance, self.options, env)
        return Run(self.config, problem, self.solver, self.planner, self.timer, self.plugins)

    def close(self) -> None:
        """Let go of the solver. Calling it twice does no harm."""
        self.solver.close()

    def __enter__(self) -> Prepared:
        return self

    def __exit__(
        self, kind: type[BaseException] | None, error: BaseException | None, traceback: TracebackType | None
    ) -> None:
        self.close()


def assemble(registry: Registry, config: RunConfig, instance: Any = None, source: str = "") -> Run:
    """Make everything that a run needs, the world as well: :func:`prepare`, and :meth:`Prepared.open`.

    Args:
        registry: Where the names are looked up.
        config: What the user asks for.
        instance: The problem, where it does not come from setting and seed.
        source: Where the instance comes from, such as its file, for messages about it.

    Raises:
        LLM3Error: A name is unknown, or the domain lacks what the strategy or the backend needs.
    """
    return prepare(registry, config, instance, source).open()


def prepare(registry: Registry, config: RunConfig, instance: Any = None, source: str = "") -> Prepared:
    """Look everything up that a run needs, and make all of it but the world.

    Args:
        registry: Where the names are looked up.
        config: What the user asks for.
        instance: The problem, where it does not come from setting and seed.
        source: Where the instance comes from, such as its file, for messages about it.

    Raises:
        LLM3Error: A name is unknown, or the domain lacks what the strategy or the backend needs.
    """
    domain = registry.domain(config.domain)
    strategy = None if config.is_search else registry.strategy(config.strategy)
    feedback = None if config.is_search else registry.feedback(config.feedback)
    planner = registry.planner(config.planner, PlannerSettings(config.planner_iterations, config.planner_seconds))
    timer = choose_timer(registry, config.timing)
    config = replace(config, timing=UNTIMED if timer is None else config.timing or USUAL_TIMER)
    if instance is None:
        instance = choose_instance(domain, config.setting, config.seed)
        config = replace(config, setting=domain.default_setting if config.setting is None else config.setting)
    solver: Solver
    if strategy is None or feedback is None:
        if config.max_motion_calls is None and config.max_seconds is None:
            config = replace(config, max_motion_calls=MOTION_CALLS)
        solver = Search(domain.regions(instance) or FrozenDict())
    else:
        prompt, skeleton = Prompt(strategy), given_skeleton(domain, instance, strategy, config.strategy)
        config = replace(config, llm=config.backend)
        backend = _backend(registry, config, domain, instance)
        config = replace(config, **backend.recorded)
        solver = Loop(backend, prompt, feedback, skeleton)
    try:
        options = settle_options(domain, config.options)
    except BaseException:
        solver.close()
        raise
    return Prepared(config, domain, instance, options, solver, planner, timer, _origins(registry, config), source)


def _backend(registry: Registry, config: RunConfig, domain: Domain, instance: Any) -> LLMBackend:
    name, _, argument = config.backend.partition(":")
    return registry.backend(
        name,
        BackendSettings(
            domain=domain.name,
            argument=argument or None,
            model=config.model,
            temperature=config.temperature,
            max_reply_tokens=config.max_reply_tokens,
            stand_in=domain.stand_in(),
            skeleton=domain.skeleton(instance) or (),
            pieces=domain.pieces(instance) or (),
            regions=domain.regions(instance) or FrozenDict(),
            run=config.run_name,
        ),
    )


def _origins(registry: Registry, config: RunConfig) -> Mapping[str, str]:
    """Where the plugins of a run come from; none is looked up that it does not use."""
    used = {"domain": config.domain, "planner": config.planner, "timer": config.timing}
    if not config.is_search:
        used |= {"strategy": config.strategy, "feedback": config.feedback, "backend": config.backend.partition(":")[0]}
    return FrozenDict(
        {
            f"{kind}/{name}": registration.plugin
            for kind, name in used.items()
            for registration in registry.registrations(kind)
            if registration.name == name
        }
    )
