"""The kitchen, seen from above."""

from __future__ import annotations

from llm3.types import Shape, State
from llm3_bullet.tabletop.outlines import outline_of_area, outline_of_box
from llm3_kitchen.instance import KitchenInstance


def top_view(instance: KitchenInstance, state: State) -> tuple[Shape, ...]:
    """The places, and the outline of each thing that is not held."""
    poses = ((thing, state.poses.get(thing.name)) for thing in instance.things)
    things = (outline_of_box(thing.name, thing.size, pose) for thing, pose in poses if pose)
    return (*(outline_of_area(place.name, place.area) for place in instance.places), *things)
