"""Registers the domain, and an experiment over all its settings."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from functools import partial
from importlib import resources

from llm3 import Domain, hookimpl


def _tabletop2d() -> Domain:
    """A disc robot moves discs and boxes in the plane."""
    from llm3_tabletop2d.domain import Tabletop2D

    return Tabletop2D()


def _experiment(name: str) -> str:
    return resources.files("llm3_tabletop2d").joinpath("experiments", f"{name}.toml").read_text(encoding="utf-8")


@hookimpl
def llm3_domains() -> Mapping[str, Callable[[], Domain]]:
    """The plane with discs and boxes."""
    return {"tabletop2d": _tabletop2d}


@hookimpl
def llm3_experiments() -> Mapping[str, Callable[[], str]]:
    """Every setting, by everything that needs no model."""
    return {"tabletop2d": partial(_experiment, "tabletop2d")}
