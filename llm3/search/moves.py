"""What a search can try: every action with every choice of objects, and parameters drawn at random."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from dataclasses import dataclass
from itertools import product

import numpy as np

from llm3.interfaces import Env, Regions
from llm3.types import Action, Sketch

DECIMALS = 4
"""Parameters are drawn to 0.1 mm and 1e-4 rad, the grid of states."""


@dataclass(frozen=True)
class Move:
    """An action whose parameters are still open."""

    sketch: Sketch
    ranges: Mapping[str, tuple[float, float]]
    """Where each parameter is drawn from, in the schema's order; empty if there is none."""

    def drawn(self, rng: np.random.Generator) -> Action:
        """The action with parameters from their ranges."""
        params: dict[str, float] = {}
        for name, (low, high) in self.ranges.items():
            value = round(float(rng.uniform(low, high)), DECIMALS)
            params[name] = min(max(value, low), high)  # rounding may step over a bound
        return Action(self.sketch.name, self.sketch.objects, params)


def moves_of(env: Env, regions: Regions) -> Iterator[Move]:
    """All moves in a world.

    Args:
        env: The world.
        regions: Tighter ranges than the schemas'.
    """
    for schema in env.schemas:
        for objects in product(env.objects, repeat=len(schema.objects)):
            ranges = {p.name: regions.get((schema.name, objects, p.name), (p.low, p.high)) for p in schema.parameters}
            yield Move(Sketch(schema.name, objects), ranges)
