"""The basket and the boxes, seen from above."""

from __future__ import annotations

from llm3.types import Shape, State
from llm3_boxpack.instance import BoxpackInstance
from llm3_bullet.tabletop.outlines import outline_of_area, outline_of_box


def top_view(instance: BoxpackInstance, state: State) -> tuple[Shape, ...]:
    """The basket's inside, and the outline of each box and thing that is not held."""
    poses = ((thing, state.poses.get(thing.name)) for thing in instance.things)
    boxes = (outline_of_box(box.name, box.size, pose) for box, pose in poses if pose)
    return (outline_of_area("basket", instance.basket.area), *boxes)
