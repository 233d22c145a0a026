"""What a tabletop looks like in pictures."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import replace

from llm3.types import Color, FrozenDict, Pose, color_of
from llm3_bullet.scene import Box
from llm3_bullet.stage import Camera
from llm3_bullet.tabletop.table import TABLE

CAMERA = Camera(target=(0.36, 0.0, 0.22), distance=1.35, yaw=55.0, pitch=-30.0)
FURNITURE: Mapping[str, Color] = FrozenDict({"table": (0.90, 0.86, 0.80), "basket": (0.45, 0.33, 0.22)})
"""By the first word of a name."""


def look(name: str) -> Color:
    """The colour of a thing that has none of its own: furniture's, or the one that its name begins with."""
    return FURNITURE.get(name.partition("_")[0]) or color_of(name)


def trimmed(box: Box) -> Box:
    """The same, but for the table, which is drawn as large as the renderer's shadows reach."""
    return replace(box, size=(1.2, 1.5, 0.05), pose=Pose((0.3, 0.0, -0.025))) if box.name == TABLE else box
