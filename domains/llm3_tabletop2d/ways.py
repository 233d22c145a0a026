"""What the robot touches on its way, and how close it may come."""

from __future__ import annotations

import numpy as np

from llm3.types import Contact, Mask, Vector
from llm3_tabletop2d.bodies import Separation
from llm3_tabletop2d.scene import ROBOT

CLEARANCE = 0.005
"""Distance in metres that the robot, and what it holds, keep from everything on a planned path."""
MARGIN = 0.001
"""The same on the straight pieces, on which it comes close to things on purpose."""
RESOLUTION = 0.008
"""How far apart the samples of a planned path are, in metres. Half of it is less than the clearance: nothing turns, so
between two samples no distance can shrink to nothing."""
EXACT = 1e-9
"""A distance may be short of what is asked by this, in metres: the rounding of floating-point numbers."""


def is_free(separation: Separation, points: Vector) -> Mask:
    """Whether planned paths may pass through these points, (N,)."""
    return np.asarray((separation.gaps(points, CLEARANCE) >= CLEARANCE - EXACT).all(axis=1))


def touched(separation: Separation, points: Vector, distance: float, carrying: str = "held") -> tuple[Contact, ...]:
    """What comes closer than a distance anywhere on these points, the deepest first, each pair of things once."""
    depth: dict[tuple[str, str], float] = {}
    deepest = -separation.gaps(points, distance).min(axis=0)
    for (mover, other), value in zip(separation.pairs, deepest.tolist(), strict=True):
        if -value < distance - EXACT:
            key = ROBOT if mover.name == ROBOT else f"{carrying} {mover.name}", other.name
            depth[key] = max(value, depth.get(key, value))
    contacts = (Contact(part, name, value) for (part, name), value in depth.items())
    return tuple(sorted(contacts, key=lambda contact: -contact.depth))
