"""What a tabletop looks like in pictures."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, replace
from typing import TYPE_CHECKING

from llm3.types import Camera, Color, FrozenDict, Pose, color_of
from llm3_bullet.scene import Box
from llm3_bullet.tabletop.table import TABLE

if TYPE_CHECKING:  # which has one of these
    from llm3_bullet.tabletop.env import TabletopEnv

CAMERA = Camera(target=(0.36, 0.0, 0.22), distance=1.35, yaw=55.0, pitch=-30.0)
FURNITURE: Mapping[str, Color] = FrozenDict({"table": (0.90, 0.86, 0.80), "basket": (0.45, 0.33, 0.22)})
"""By the first word of a name."""


@dataclass(frozen=True)
class Seen:
    """What there is to see beside the robot."""

    boxes: tuple[Box, ...]
    colors: Mapping[str, Color]
    """Of all boxes, by name."""
    camera: Camera


def seen(env: TabletopEnv) -> Seen:
    """What a world shows at its start."""
    boxes = (*map(trimmed, env.scene(env.reset()).boxes), *env.marks)
    return Seen(boxes, {box.name: env.colors.get(box.name) or look(box.name) for box in boxes}, env.camera)


def look(name: str) -> Color:
    """The colour of a thing that has none of its own: furniture's, or the one that its name begins with."""
    return FURNITURE.get(name.partition("_")[0]) or color_of(name)


def trimmed(box: Box) -> Box:
    """The same, but for the table, which is drawn as large as the renderer's shadows reach."""
    return replace(box, size=(1.2, 1.5, 0.05), pose=Pose((0.3, 0.0, -0.025))) if box.name == TABLE else box
