"""Which answers go wrong, and how."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Mapping
from dataclasses import dataclass

import numpy as np

from llm3.errors import UnknownName, UsageError


@dataclass(frozen=True)
class Faults:
    """Which answers go wrong, and how; made by `at` or `at_rate`."""

    kinds: frozenset[str]
    """The names of all faults that may come."""
    choose: Callable[[int], str | None]
    """The fault of an answer by its number, counted from 1; None for a good one. Called once for each, in order."""
    rng: np.random.Generator
    """Chooses what of a reply is spoilt."""

    @classmethod
    def at(cls, places: Mapping[int, str], rng: np.random.Generator | None = None) -> Faults:
        """Faults at given places.

        Args:
            places: The name of the fault by the number of the answer, counted from 1.
            rng: Chooses what of a reply is spoilt; without one, the same replies are always spoilt alike.

        Raises:
            UsageError: A number is below 1.
        """
        for number in places:
            if number < 1:
                raise UsageError(f"answers are counted from 1: there is no fault at {number}.")
        chosen = dict(places)
        return cls(frozenset(chosen.values()), chosen.get, np.random.default_rng(0) if rng is None else rng)

    @classmethod
    def at_rate(cls, rate: float, kinds: Iterable[str], rng: np.random.Generator) -> Faults:
        """Faults by chance.

        Args:
            rate: The share of the answers that go wrong, from 0 to 1.
            kinds: The names of the faults, of which each is drawn as often as any other.
            rng: Draws whether, which, and what of a reply is spoilt.

        Raises:
            UsageError: The rate is out of range, or there is nothing to draw from.
        """
        names = tuple(kinds)
        if not 0 <= rate <= 1:
            raise UsageError(f"the rate of faults must be from 0 to 1, not {rate:g}.")
        if not names:
            raise UsageError("faults at a rate need at least one kind of fault.")

        def draw(_: int) -> str | None:
            return names[rng.integers(len(names))] if rng.random() < rate else None

        return cls(frozenset(names), draw, rng)

    def check(self, known: Iterable[str]) -> None:
        """Make sure that all kinds are known.

        Raises:
            UnknownName: One is not.
        """
        valid = tuple(known)
        for name in sorted(self.kinds.difference(valid)):
            raise UnknownName("fault", name, valid)
