"""What a search can try: every action with every choice of objects, and parameters drawn at random."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass
from itertools import product

import numpy as np

from llm3.interfaces import Env, Ranges, Regions, drawn, sampling_ranges
from llm3.types import Action, Sketch


@dataclass(frozen=True)
class Move:
    """An action whose parameters are still open."""

    sketch: Sketch
    ranges: Ranges
    """Where each parameter is drawn from; empty if there is none."""

    def drawn(self, rng: np.random.Generator) -> Action:
        """The action with parameters from their ranges."""
        return drawn(self.sketch, self.ranges, rng)


def moves_of(env: Env, regions: Regions) -> Iterator[Move]:
    """All moves in a world.

    Args:
        env: The world.
        regions: Tighter ranges than the schemas'.

    Raises:
        PluginError: A region is no range, or lies outside of the schema's.
    """
    for schema in env.schemas:
        for objects in product(env.objects, repeat=len(schema.objects)):
            yield Move(Sketch(schema.name, objects), sampling_ranges(schema, objects, regions))
