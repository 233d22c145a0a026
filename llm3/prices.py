"""What a run cost, by a price table of the user's own. None is built in: prices change, and a wrong bill is none."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from math import inf
from pathlib import Path

from llm3.jsonio import read_file
from llm3.types import Stats

TOKENS = 1_000_000
"""A price is for so many."""


@dataclass(frozen=True)
class Price:
    """What a million tokens cost, in a currency of the user's choice."""

    read: float
    written: float
    """Those of the model's reasoning included."""
    cached: float | None = None
    """Read from a cache of the server; None: as any other."""

    def __post_init__(self) -> None:
        for name in ("read", "written", "cached"):
            value = getattr(self, name)
            if value is not None and not 0 <= value < inf:
                raise ValueError(f"{name} must be a price of 0 or more, not {value:g}")

    def of(self, stats: Stats) -> float:
        """What these tokens cost."""
        cached = self.read if self.cached is None else self.cached
        from_cache = min(stats.cached_tokens, stats.prompt_tokens)
        read = (stats.prompt_tokens - from_cache) * self.read + from_cache * cached
        return (read + stats.completion_tokens * self.written) / TOKENS


def read_prices(path: Path) -> Mapping[str, Price]:
    """A price table, by the model's name as `--model` has it.

    Raises:
        InputError: The file cannot be read, or is none.
    """
    return read_file(path, dict[str, Price])
