"""The hooks that a plugin may implement.

Each hook returns factories by name and is called once, when the registry loads the plugin; a factory is called when
its name is asked for, so heavy imports belong inside it. A plugin is a module (or an object) named by an entry point
of group ``llm3``; it implements any of these functions, marked with :data:`hookimpl`::

    from llm3 import hookimpl

    @hookimpl
    def llm3_domains():
        return {"corridor": Corridor}

Within a major version, hooks and factory signatures only ever grow by optional parts.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping

import pluggy

from llm3.interfaces import (
    BackendSettings,
    Domain,
    FeedbackSynthesizer,
    LLMBackend,
    ModelSource,
    MotionPlanner,
    PlannerSettings,
    Strategy,
    TrajectoryTimer,
)

hookspec = pluggy.HookspecMarker("llm3")
hookimpl = pluggy.HookimplMarker("llm3")


@hookspec
def llm3_domains() -> Mapping[str, Callable[[], Domain]]:  # type: ignore[empty-body]  # a specification only
    """Domains, for ``--domain NAME``.

    The factory takes nothing and is cheap: what a world needs is imported in `Domain.make`.
    """


@hookspec
def llm3_planners() -> Mapping[str, Callable[[PlannerSettings], MotionPlanner]]:  # type: ignore[empty-body]  # a specification only
    """Motion planners, for ``--planner NAME``. The factory takes the budget of a query."""


@hookspec
def llm3_feedback() -> Mapping[str, Callable[[], FeedbackSynthesizer]]:  # type: ignore[empty-body]  # a specification only
    """Feedback levels, for ``--feedback NAME``."""


@hookspec
def llm3_backends() -> Mapping[str, Callable[[BackendSettings], LLMBackend]]:  # type: ignore[empty-body]  # a specification only
    """Model backends, for ``--llm NAME``. The factory takes what the user asked for."""


@hookspec
def llm3_strategies() -> Mapping[str, Callable[[], Strategy]]:  # type: ignore[empty-body]  # a specification only
    """Prompt strategies, for ``--strategy NAME``."""


@hookspec
def llm3_timers() -> Mapping[str, Callable[[], TrajectoryTimer]]:  # type: ignore[empty-body]  # a specification only
    """Timers, for ``--timing NAME``: they put times to the paths of a plan."""


@hookspec
def llm3_model_sources() -> Mapping[str, Callable[[Mapping[str, str]], tuple[ModelSource, ...]]]:  # type: ignore[empty-body]  # a specification only
    """Where models can be had, for ``llm3 models``, by the name of the backend that asks them.

    The factory takes the environment variables.
    """


@hookspec
def llm3_experiments() -> Mapping[str, Callable[[], str]]:  # type: ignore[empty-body]  # a specification only
    """Experiments, for ``llm3 experiment NAME``. The factory answers the text of a TOML file."""
