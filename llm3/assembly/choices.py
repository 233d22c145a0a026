"""What a domain and the registry have to offer for what a user names."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

from llm3.assembly.config import UNTIMED, USUAL_TIMER
from llm3.errors import MissingCapability, MissingDependency, PluginError, UnknownName
from llm3.guarded import guarded
from llm3.interfaces import Domain, Options, Strategy, TrajectoryTimer
from llm3.jsonio import dumps
from llm3.registry import Registry
from llm3.types import FrozenDict, Sketch


def choose_instance(domain: Domain, setting: str | None, seed: int) -> Any:
    """The instance of a setting, or of the default one, and a seed.

    Raises:
        UnknownName: The domain has no such setting.
        PluginError: What the domain answers has no JSON form.
    """
    setting = domain.default_setting if setting is None else setting
    if setting not in domain.settings:
        raise UnknownName("setting", setting, domain.settings, owner=f"domain {domain.name!r}")
    instance = guarded(domain.instance, (domain.instance_type,), setting, seed)
    try:
        dumps(instance)
    except (TypeError, ValueError, RecursionError) as error:
        reason = f"an instance of domain {domain.name!r} cannot be written to a file: {error}"
        raise PluginError(f"{reason}. Its fields are dataclasses, tuples, dicts, texts and numbers.") from error
    return instance


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


def settle_options(domain: Domain, given: Mapping[str, str]) -> Options:
    """A value for every option of the domain, as a record keeps them: `Domain.self_contained`.

    Raises:
        UnknownName: The domain has no such option, or the option no such value.
    """
    return FrozenDict(guarded(domain.self_contained, (Mapping,), choose_options(domain, given)))


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
