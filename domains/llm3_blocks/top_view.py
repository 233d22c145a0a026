"""The blocks, seen from above."""

from __future__ import annotations

from llm3.types import Shape, State
from llm3_blocks.instance import BlocksInstance
from llm3_bullet.tabletop.outlines import outline_of_box


def top_view(instance: BlocksInstance, state: State) -> tuple[Shape, ...]:
    """The outline of each block that is not held, the lowest first."""
    from_below = sorted(state.poses.items(), key=lambda item: item[1].position[2])
    return tuple(outline_of_box(name, instance.sizes[name], pose) for name, pose in from_below)
