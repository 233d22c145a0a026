"""Registers the domain, and an experiment over its settings."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from functools import partial
from importlib import resources

from llm3 import Domain, hookimpl


def _kitchen() -> Domain:
    """An arm fetches food from among clutter, washes, heats and serves it."""
    from llm3_kitchen.domain import Kitchen

    return Kitchen()


def _experiment(name: str) -> str:
    return resources.files("llm3_kitchen").joinpath("experiments", f"{name}.toml").read_text(encoding="utf-8")


@hookimpl
def llm3_domains() -> Mapping[str, Callable[[], Domain]]:
    """The kitchen."""
    return {"kitchen": _kitchen}


@hookimpl
def llm3_experiments() -> Mapping[str, Callable[[], str]]:
    """The settings, by all that needs no model."""
    return {"kitchen": partial(_experiment, "kitchen")}
