"""Registers the domain, and the experiments of the paper."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from functools import partial
from importlib import resources

from llm3 import Domain, hookimpl


def _boxpack() -> Domain:
    """An arm packs boxes into a basket on a table."""
    from llm3_boxpack.domain import BoxPack

    return BoxPack()


def _experiment(name: str) -> str:
    return resources.files("llm3_boxpack").joinpath("experiments", f"{name}.toml").read_text(encoding="utf-8")


@hookimpl
def llm3_domains() -> Mapping[str, Callable[[], Domain]]:
    """The paper's box-packing task."""
    return {"boxpack": _boxpack}


@hookimpl
def llm3_experiments() -> Mapping[str, Callable[[], str]]:
    """Tables I and II of the paper, one of harder problems, and one to see that everything works."""
    return {name: partial(_experiment, name) for name in ("table1", "table2", "frontier", "smoke")}
