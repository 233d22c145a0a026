"""Words for numbers."""

from __future__ import annotations


def counted(number: int, noun: str) -> str:
    """A number and what it counts, such as ``1 run`` or ``1,200 runs``."""
    return f"{number:,} {noun}{'s' * (number != 1)}"
