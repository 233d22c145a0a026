"""Registers the backends that stand in for a language model."""

from __future__ import annotations

from collections.abc import Callable, Mapping

from llm3 import BackendSettings, LLMBackend, hookimpl


def _offline(settings: BackendSettings) -> LLMBackend:
    """No model: the domain's own rules, or random parameters where it has none."""
    from llm3_standins.offline import offline

    return offline(settings)


def _random(settings: BackendSettings) -> LLMBackend:
    """No model: uniform random parameters over the domain's action sequence."""
    from llm3_standins.sampler import RandomBackend

    return RandomBackend(settings)


def _scripted(settings: BackendSettings) -> LLMBackend:
    """No model: replies from a file, --llm scripted:replies.json."""
    from llm3_standins.script_file import scripted_from_file

    return scripted_from_file(settings)


@hookimpl
def llm3_backends() -> Mapping[str, Callable[[BackendSettings], LLMBackend]]:
    """The rule-based stand-in, the random sampler, and replies from a file."""
    return {"offline": _offline, "random": _random, "scripted": _scripted}
