"""Registers the domain, and its experiment."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from importlib import resources

from llm3 import Domain, hookimpl


def _blocks() -> Domain:
    """An arm builds towers of blocks on a table."""
    from llm3_blocks.domain import Blocks

    return Blocks()


def _experiment() -> str:
    return resources.files("llm3_blocks").joinpath("experiments", "blocks.toml").read_text(encoding="utf-8")


@hookimpl
def llm3_domains() -> Mapping[str, Callable[[], Domain]]:
    """Towers of blocks."""
    return {"blocks": _blocks}


@hookimpl
def llm3_experiments() -> Mapping[str, Callable[[], str]]:
    """Towers of three to six blocks, without a model."""
    return {"blocks": _experiment}
