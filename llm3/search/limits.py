"""How far a probe of the search goes before the next one begins."""

from __future__ import annotations

from dataclasses import dataclass

WIDTH = 8
"""Samples of an action's parameters in a narrow probe."""
PLATEAU = 1
"""Actions in a row that may bring no progress in a narrow probe."""
SHARE = 32
"""Motion calls of a narrow probe."""


@dataclass(frozen=True)
class Limits:
    """The limits of one probe."""

    level: int
    """0 for a narrow probe."""

    @classmethod
    def of(cls, probe: int) -> Limits:
        """Those of a probe, counted from 1: 2 to the level is the universal sequence, 1, 1, 2, 1, 1, 2, 4 and on."""
        bits = probe.bit_length()
        return cls(bits - 1) if probe == 2**bits - 1 else cls.of(probe - 2 ** (bits - 1) + 1)

    @property
    def width(self) -> int:
        """Samples of an action's parameters in a state."""
        return WIDTH * (self.level + 1)

    @property
    def plateau(self) -> int:
        """Actions in a row that may bring no progress."""
        return PLATEAU + self.level

    @property
    def setback(self) -> int:
        """How many more parts of the goal may be unmet than at the best moment before."""
        return self.level

    @property
    def share(self) -> int:
        """Motion calls of the whole probe."""
        return SHARE << self.level
