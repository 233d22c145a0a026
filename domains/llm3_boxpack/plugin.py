"""Registers the box-packing domain."""

from __future__ import annotations

from collections.abc import Callable, Mapping

from llm3 import Domain, hookimpl


def _boxpack() -> Domain:
    from llm3_boxpack.domain import BoxPack

    return BoxPack()


@hookimpl
def llm3_domains() -> Mapping[str, Callable[[], Domain]]:
    """The domain ``boxpack``."""
    return {"boxpack": _boxpack}
