"""What the state says of the food beside where it is."""

from __future__ import annotations

from collections.abc import Iterable, Mapping

from llm3.types import Fact, State

WASHED, HEATED = "washed", "heated"


def at_first(foods: Iterable[str]) -> dict[str, Fact]:
    """The facts of the initial state: nothing is washed or heated.

    Args:
        foods: Names.
    """
    return {_key(name, deed): False for name in foods for deed in (WASHED, HEATED)}


def is_true(state: State, name: str, deed: str) -> bool:
    """Whether a food is `WASHED` or `HEATED`."""
    return bool(state.facts[_key(name, deed)])


def made_true(state: State, name: str, deed: str) -> Mapping[str, Fact]:
    """The facts after a food was washed or heated."""
    return {**state.facts, _key(name, deed): True}


def _key(name: str, deed: str) -> str:
    return f"{name} {deed}"
