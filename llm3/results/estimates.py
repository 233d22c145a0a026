"""A figure with its interval."""

from __future__ import annotations

from dataclasses import dataclass

LEVEL = 0.95
"""How often an interval should hold the true value."""


@dataclass(frozen=True)
class Estimate:
    """A mean, or a share, and where its true value may lie."""

    n: int
    """Of how many values, or pairs of values."""
    mean: float
    interval: tuple[float, float] | None
    """The lower and the upper end of a 95 % confidence interval; None where too little is known for one."""
