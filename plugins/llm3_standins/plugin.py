"""Registers the backends that stand in for a language model."""

from __future__ import annotations

from collections.abc import Callable, Mapping

from llm3 import BackendSettings, LLMBackend, hookimpl
from llm3.errors import UsageError


def _offline(settings: BackendSettings) -> LLMBackend:
    """No model: the domain's own rules, or random parameters where it has none."""
    from llm3_standins.offline import offline

    _refuse(settings, "offline")
    return offline(settings)


def _random(settings: BackendSettings) -> LLMBackend:
    """No model: uniform random parameters over the domain's action sequence."""
    from llm3_standins.sampler import RandomBackend

    _refuse(settings, "random")
    return RandomBackend(settings)


def _scripted(settings: BackendSettings) -> LLMBackend:
    """No model: replies from a file, --llm scripted:replies.json."""
    from llm3_standins.script_file import scripted_from_file

    _refuse(settings, "scripted", takes_argument=True)
    return scripted_from_file(settings)


def _refuse(settings: BackendSettings, name: str, takes_argument: bool = False) -> None:
    if settings.argument is not None and not takes_argument:
        raise UsageError(f"the backend {name!r} takes no argument, so leave out ':{settings.argument}'.")
    if settings.model is not None:
        raise UsageError(f"the backend {name!r} uses no language model: leave out --model {settings.model}, or --llm.")


@hookimpl
def llm3_backends() -> Mapping[str, Callable[[BackendSettings], LLMBackend]]:
    """The rule-based stand-in, the random sampler, and replies from a file."""
    return {"offline": _offline, "random": _random, "scripted": _scripted}
