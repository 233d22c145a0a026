"""Which plugins there are, who brought them, and which of them failed to load."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Mapping
from dataclasses import dataclass
from importlib import metadata
from typing import Any, TypeVar

import pluggy

from llm3 import hookspecs
from llm3.errors import LLM3Error, PluginError, UnknownName
from llm3.guarded import place
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

ENTRY_POINT_GROUP = "llm3"
HOOKS = {
    "domain": "llm3_domains",
    "strategy": "llm3_strategies",
    "feedback": "llm3_feedback",
    "planner": "llm3_planners",
    "timer": "llm3_timers",
    "backend": "llm3_backends",
    "model source": "llm3_model_sources",
    "experiment": "llm3_experiments",
}
"""The hook that brings each kind of thing."""

T = TypeVar("T")


@dataclass(frozen=True)
class Registration:
    """One name that a plugin brought."""

    kind: str
    name: str
    factory: Callable[..., Any]
    plugin: str
    """Where it comes from, such as ``"boxpack (llm3 0.1.0)"``."""


@dataclass(frozen=True)
class BrokenPlugin:
    """A plugin that could not be loaded."""

    plugin: str
    reason: str


class Registry:
    """All plugins of one program, held by whoever made it. There is no global one."""

    def __init__(self) -> None:
        """Start empty; :meth:`discover` is the usual way to a full one."""
        self._manager = pluggy.PluginManager("llm3")
        self._manager.add_hookspecs(hookspecs)
        self._registrations: list[Registration] = []
        self.broken: tuple[BrokenPlugin, ...] = ()

    @classmethod
    def discover(cls, entry_points: Iterable[metadata.EntryPoint] | None = None) -> Registry:
        """Load every installed plugin; one that fails is remembered in `broken` and the rest goes on.

        Args:
            entry_points: What to load instead of the installed entry points of group ``llm3``.

        Raises:
            PluginError: No plugin is installed at all.
        """
        registry = cls()
        if entry_points is None:
            entry_points = metadata.entry_points(group=ENTRY_POINT_GROUP)
        found = sorted(entry_points, key=lambda e: (_distribution(e) != "llm3", _distribution(e), e.name))
        if not found:
            raise PluginError("llm3 is not installed, so it has no plugins: run 'pip install .' in its checkout.")
        for entry_point in found:
            plugin = _origin(entry_point)
            try:
                registry.register(entry_point.load(), plugin)
            except LLM3Error as error:
                registry._remember(plugin, str(error))
            except (Exception, SystemExit) as error:  # whatever a stranger's import raises must not kill the program
                at = place(error, entry_point.module.partition(".")[0])
                registry._remember(plugin, f"{type(error).__name__}: {error}" + f" ({at})" * bool(at))
        return registry

    def register(self, plugin: object, name: str) -> None:
        """Add one plugin: a module or an object with hook implementations.

        Args:
            plugin: The module or object.
            name: Where it comes from, for messages and ``llm3 list``.

        Raises:
            PluginError: It is there already, implements no hook or an unknown one or one with wrong arguments,
                answers with something that is not a dict of factories, or claims a name that another plugin has.
        """
        if self._manager.has_plugin(name) or self._manager.is_registered(plugin):
            raise PluginError(f"plugin {name} is registered twice.")
        try:
            self._manager.register(plugin, name)
            found = self._read(plugin, name)
        except BaseException as error:
            if self._manager.is_registered(plugin):
                self._manager.unregister(plugin)
            if isinstance(error, pluggy.PluginValidationError):
                raise PluginError(f"plugin {name} does not fit the hooks: {error}") from error
            raise
        self._registrations += found

    def _read(self, plugin: object, name: str) -> list[Registration]:
        known = ", ".join(sorted(HOOKS.values()))
        callers = self._manager.get_hookcallers(plugin) or ()
        unknown = ", ".join(repr(caller.name) for caller in callers if not caller.has_spec())
        try:
            self._manager.check_pending()
        except pluggy.PluginValidationError as error:
            raise PluginError(f"plugin {name} implements an unknown hook, {unknown}. Hooks: {known}.") from error
        found: list[Registration] = []
        implemented = [caller.name for caller in callers]
        if not implemented:
            raise PluginError(f"plugin {name} implements no hook; mark a function with @hookimpl. Hooks: {known}.")
        for kind, hook in HOOKS.items():
            if hook not in implemented:
                continue
            others = [p for p in self._manager.get_plugins() if p is not plugin]
            (answer,) = self._manager.subset_hook_caller(hook, others)() or (None,)
            if not isinstance(answer, Mapping) or not all(
                isinstance(key, str) and callable(value) for key, value in answer.items()
            ):
                raise PluginError(f"plugin {name}: {hook} must return a dict of factories by name, not {answer!r}.")
            for thing, factory in answer.items():
                for other in self._registrations:
                    if (other.kind, other.name) == (kind, thing):
                        raise PluginError(f"{kind} {thing!r} is registered by {other.plugin} and by {name}.")
                found.append(Registration(kind, thing, factory, name))
        return found

    def _remember(self, plugin: str, reason: str) -> None:
        self.broken += (BrokenPlugin(plugin, " ".join(reason.split())),)

    def registrations(self, kind: str) -> tuple[Registration, ...]:
        """Everything of one kind, by name."""
        return tuple(sorted((r for r in self._registrations if r.kind == kind), key=lambda r: r.name))

    def names(self, kind: str) -> tuple[str, ...]:
        """The names of one kind."""
        return tuple(r.name for r in self.registrations(kind))

    def _make(self, expected: type[T], kind: str, name: str, *arguments: Any) -> T:
        for registration in self.registrations(kind):
            if registration.name == name:
                made = _made(registration, arguments)
                if not isinstance(made, expected):
                    wanted, got = expected.__name__, type(made).__name__
                    raise PluginError(f"{registration.plugin}: {kind} {name!r} made a {got}, not a {wanted}.")
                return made
        raise self.unknown(kind, name, self.names(kind))

    def unknown(self, kind: str, name: str, known: Iterable[str]) -> LLM3Error:
        """What to raise where there is no such name: a plugin that failed to load is the likely reason."""
        for broken in self.broken:
            if broken.plugin.partition(" (")[0] == name:
                return PluginError(f"plugin {broken.plugin} cannot be loaded: {broken.reason.removesuffix('.')}.")
        failed = "; ".join(f"{broken.plugin} ({broken.reason})" for broken in self.broken)
        return UnknownName(kind, name, known, remark=f"Failed to load: {failed}." if failed else "")

    def domain(self, name: str) -> Domain:
        """The domain of this name.

        Raises:
            UnknownName: There is none; the message has close matches and the plugins that failed to load.
            PluginError: What was made is no domain, or has another name.
        """
        domain = self._make(Domain, "domain", name)  # type: ignore[type-abstract]  # isinstance is all it is used for
        registration = next(r for r in self._registrations if (r.kind, r.name) == ("domain", name))
        for attribute in ("name", "description", "settings", "default_setting", "instance_type"):
            if not hasattr(domain, attribute):
                raise PluginError(f"{registration.plugin}: domain {name!r} has no attribute {attribute!r}.")
        if domain.default_setting not in domain.settings:
            raise PluginError(
                f"{registration.plugin}: the default setting {domain.default_setting!r} of domain {name!r} is none of "
                f"its settings: {', '.join(domain.settings) or 'none'}."
            )
        if domain.name != name:
            raise PluginError(f"domain {name!r} is registered under another name than its own, {domain.name!r}.")
        return domain

    def strategy(self, name: str) -> Strategy:
        """The prompt strategy of this name; raises like :meth:`domain`."""
        return self._make(Strategy, "strategy", name)

    def planner(self, name: str, settings: PlannerSettings | None = None) -> MotionPlanner:
        """The motion planner of this name; raises like :meth:`domain`."""
        return self._make(MotionPlanner, "planner", name, settings or PlannerSettings())  # type: ignore[type-abstract]  # as above

    def timer(self, name: str) -> TrajectoryTimer:
        """The timer of this name; raises like :meth:`domain`."""
        return self._make(TrajectoryTimer, "timer", name)  # type: ignore[type-abstract]  # as above

    def feedback(self, name: str) -> FeedbackSynthesizer:
        """The feedback level of this name; raises like :meth:`domain`."""
        return self._make(FeedbackSynthesizer, "feedback", name)  # type: ignore[type-abstract]  # as above

    def backend(self, name: str, settings: BackendSettings | None = None) -> LLMBackend:
        """The model backend of this name; raises like :meth:`domain`."""
        return self._make(LLMBackend, "backend", name, settings or BackendSettings())  # type: ignore[type-abstract]  # as above

    def experiment(self, name: str) -> str:
        """The TOML text of the experiment of this name; raises like :meth:`domain`."""
        return self._make(str, "experiment", name)

    def model_sources(self, environment: Mapping[str, str]) -> tuple[ModelSource, ...]:
        """Where models can be had, of all plugins, by name.

        Args:
            environment: The environment variables.

        Raises:
            PluginError: A plugin answered something else.
            LLM3Error: A plugin cannot read what the user gave it, such as a file.
        """
        found: list[ModelSource] = []
        for registration in self.registrations("model source"):
            made = _made(registration, (environment,))
            if not isinstance(made, tuple) or not all(isinstance(source, ModelSource) for source in made):
                raise PluginError(
                    f"{registration.plugin}: model source {registration.name!r} must answer a tuple of ModelSource, "
                    f"not {made!r}."
                )
            found += made
        return tuple(sorted(found, key=lambda source: source.name))


def _made(registration: Registration, arguments: tuple[Any, ...]) -> Any:
    try:
        return registration.factory(*arguments)
    except LLM3Error:
        raise
    except (Exception, SystemExit) as error:
        what = f"{registration.kind} {registration.name!r} cannot be made"
        raise PluginError(f"{registration.plugin}: {what}: {type(error).__name__}: {error}") from error


def _distribution(entry_point: metadata.EntryPoint) -> str:
    return (entry_point.dist.name or "") if entry_point.dist else ""  # its metadata may be gone, as while pip works


def _origin(entry_point: metadata.EntryPoint) -> str:
    if not entry_point.dist:
        return entry_point.name
    return f"{entry_point.name} ({entry_point.dist.name} {entry_point.dist.version})"
