"""Which place a thing stands in."""

from __future__ import annotations

from llm3.types import State
from llm3_bullet.scene import Size
from llm3_bullet.tabletop.stance import shadow
from llm3_kitchen.instance import KitchenInstance, PlaceSpec

TOLERANCE = 0.001
"""A footprint may reach out of its place by this much, in metres: what a release and rounding can cost."""


def place_of(instance: KitchenInstance, state: State, name: str, size: Size) -> PlaceSpec | None:
    """Where a thing stands with its whole footprint, within `TOLERANCE`; None for what is held, or stands between."""
    pose = state.poses.get(name)
    return instance.place_of(shadow(pose, size), TOLERANCE) if pose else None
