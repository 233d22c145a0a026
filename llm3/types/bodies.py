"""What things look like, in three dimensions."""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import dataclass
from typing import Literal

import numpy as np
from numpy.typing import ArrayLike, NDArray

from llm3.types.drawing import GREY, Color

Corners = NDArray[np.float64]
"""Points x, y, z in metres, shape (N, 3)."""
Triangles = NDArray[np.int64]
"""Triples of corners by their number, counter-clockwise seen from outside, shape (M, 3)."""


@dataclass(frozen=True, eq=False)
class Surface:
    """A piece of what a body looks like, in the body's own frame."""

    corners: Corners
    triangles: Triangles
    color: Color = GREY

    def __post_init__(self) -> None:
        corners, triangles = np.asarray(self.corners, dtype=float), np.asarray(self.triangles, dtype=int)
        if any(array.ndim != 2 or array.shape[1] != 3 for array in (corners, triangles)):
            shapes = f"{corners.shape} and {triangles.shape}"
            raise ValueError(f"a surface has corners of shape (N, 3) and triangles of shape (M, 3), not {shapes}")
        if not np.isfinite(corners).all():
            raise ValueError("the corners of a surface must be finite")
        if ((triangles < 0) | (triangles >= len(corners))).any():
            raise ValueError(f"the triangles of a surface go by the numbers of its {len(corners)} corners, from 0")
        object.__setattr__(self, "corners", corners)
        object.__setattr__(self, "triangles", triangles)


@dataclass(frozen=True, eq=False)
class Body:
    """A thing that moves as a whole."""

    name: str
    """As failures call it: an object, a piece of furniture, or a link of the robot."""
    surfaces: tuple[Surface, ...]
    kind: Literal["robot", "object", "fixed"] = "object"
    """A link of the robot, something that can be moved, or something that never is."""

    def __post_init__(self) -> None:
        if not self.surfaces:
            raise ValueError(f"body {self.name!r} needs at least one surface: leave out what cannot be seen")
        object.__setattr__(self, "surfaces", tuple(self.surfaces))


def box_surface(size: Iterable[float], color: Color = GREY) -> Surface:
    """A box around the origin.

    Args:
        size: Full side lengths in metres.
        color: Its colour.
    """
    x, y = (side / 2 for side in tuple(size)[:2])
    return prism_surface(((-x, -y), (x, -y), (x, y), (-x, y)), tuple(size)[2], color)


def prism_surface(outline: ArrayLike, height: float, color: Color = GREY) -> Surface:
    """An upright prism, half of it above z = 0 and half below.

    Args:
        outline: Corners x, y in metres, counter-clockwise seen from above, of a convex polygon: shape (N, 2).
        height: In metres.
        color: Its colour.
    """
    flat = np.asarray(outline, dtype=float)
    count = len(flat)
    corners = np.vstack([np.column_stack([flat, np.full(count, z)]) for z in (-height / 2, height / 2)])
    here, there = np.arange(count), np.roll(np.arange(count), -1)
    sides = [*zip(here, there, there + count, strict=True), *zip(here, there + count, here + count, strict=True)]
    fan = [(0, i, i + 1) for i in range(1, count - 1)]
    ends = [(a, c, b) for a, b, c in fan] + [(a + count, b + count, c + count) for a, b, c in fan]
    return Surface(corners, np.array([*sides, *ends]), color)
