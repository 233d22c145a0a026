"""Drawings of moments, seen from above, ready to be written as SVG."""

from __future__ import annotations

from collections.abc import Container, Iterable, Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from llm3.playback import Touch, touching
from llm3.report.labels import Label, labels
from llm3.types import Color, Shape, color_of

Point = NDArray[np.float64]
"""x, y in metres, shape (2,)."""
MARGIN = 0.12
"""Around what is shown, as a part of its larger side."""
SMALLEST = 0.2
"""The least side of what is shown, in metres."""
GROUND = 4.0
"""What is fixed and so many times as large as all that can be moved is the ground that it stands on: it is cut off."""


@dataclass(frozen=True)
class Window:
    """What of the world is shown, in metres."""

    left: float
    bottom: float
    width: float
    height: float

    @property
    def view_box(self) -> str:
        """For SVG, in millimetres; its y axis points down."""
        return " ".join(f"{1000 * v:.0f}" for v in (self.left, -self.bottom - self.height, self.width, self.height))


@dataclass(frozen=True)
class Polygon:
    """An outline as SVG has it."""

    name: str
    kind: str
    """``robot``, ``fixed`` or ``object``."""
    points: str
    """In millimetres."""
    fill: str
    center: tuple[float, float]
    """In millimetres."""


@dataclass(frozen=True)
class Drawing:
    """A moment, seen from above."""

    title: str
    """What it shows, for those who cannot see it."""
    window: Window
    polygons: tuple[Polygon, ...]
    marked: tuple[Polygon, ...] = ()
    """Those of them that touch something."""
    blamed: tuple[Polygon, ...] = ()
    """Those of them that are to blame, and touch nothing yet."""
    dots: tuple[tuple[float, float], ...] = ()
    """Where they touch, in millimetres."""

    @property
    def labels(self) -> tuple[Label, ...]:
        """The names of all that can be moved, and of a robot of one piece, each once."""
        robot = [polygon for polygon in self.polygons if polygon.kind == "robot"]
        named = [polygon for polygon in self.polygons if polygon.kind == "object"] + robot * (len(robot) == 1)
        places = {polygon.name: (polygon.name, *polygon.center) for polygon in named}
        left, right = 1000 * self.window.left, 1000 * (self.window.left + self.window.width)
        return tuple(labels(sorted(places.values(), key=lambda place: place[2]), self.text_size, left, right))

    @property
    def text_size(self) -> float:
        """In millimetres."""
        return 1000 * 0.035 * max(self.window.width, self.window.height)


def window_around(shapes: Iterable[Shape]) -> Window:
    """A window on everything that can be moved, and on what is fixed but not the ground.

    Args:
        shapes: All that is to be seen in any of the drawings.
    """
    shapes = [shape for shape in shapes if not shape.robot]
    low, high = _range([shape for shape in shapes if not shape.fixed] or shapes)
    area = float(np.prod(np.maximum(high - low, SMALLEST)))
    small = [
        shape for shape in shapes if not shape.fixed or float(np.prod(np.subtract(*_range([shape])))) < GROUND * area
    ]
    low, high = _range(small or shapes)
    middle, side = (low + high) / 2, np.maximum(high - low, SMALLEST)
    side = side + 2 * MARGIN * side.max()
    left, bottom = middle - side / 2
    return Window(float(left), float(bottom), float(side[0]), float(side[1]))


def nearer(window: Window, shapes: Sequence[Shape], names: Container[str]) -> Window:
    """A window half as large, or as large as need be to hold some of what it shows.

    Args:
        window: The larger one.
        shapes: What is to be seen.
        names: Those of them that matter.
    """
    low, high = _range([shape for shape in shapes if shape.name in names])
    middle, side = (low + high) / 2, max(window.width, window.height) / 2
    width, height = np.maximum((high - low) * (1 + 2 * MARGIN), side).tolist()
    return Window(float(middle[0]) - width / 2, float(middle[1]) - height / 2, width, height)


def drawing(
    title: str,
    window: Window,
    shapes: Sequence[Shape],
    touches: Sequence[Touch] = (),
    to_blame: Container[str] = (),
) -> Drawing:
    """Draw outlines, and mark what touches.

    Args:
        title: What it shows, for those who cannot see it.
        window: What of it is in the picture.
        shapes: What lies on top last.
        touches: What touches what.
        to_blame: The names of what else is to blame.
    """
    names = touching(touches)
    polygons = tuple(map(_polygon, shapes))
    marked = tuple(polygon for polygon in polygons if polygon.name in names)
    points = (touch.contact.point for touch in touches if touch.contact.point)
    blamed = tuple(polygon for polygon in polygons if polygon.name in to_blame and polygon.name not in names)
    return Drawing(title, window, polygons, marked, blamed, tuple((1000 * p[0], -1000 * p[1]) for p in points))


def _area(shape: Shape) -> float:
    """Of the upright rectangle around it."""
    low, high = _range([shape])
    return float(np.prod(high - low))


def _range(shapes: Sequence[Shape]) -> tuple[Point, Point]:
    corners = np.array([corner for shape in shapes for corner in shape.corners] or [(0.0, 0.0)])
    return corners.min(axis=0), corners.max(axis=0)


def _polygon(shape: Shape) -> Polygon:
    corners = np.array(shape.corners) * (1000, -1000)
    points = " ".join(f"{x:.1f},{y:.1f}" for x, y in corners)
    kind = "robot" if shape.robot else "fixed" if shape.fixed else "object"
    x, y = (corners.min(axis=0) + corners.max(axis=0)) / 2
    return Polygon(shape.name, kind, points, _hexadecimal(shape.color or color_of(shape.name)), (float(x), float(y)))


def _hexadecimal(color: Color) -> str:
    return "#" + "".join(f"{round(255 * part):02x}" for part in color)
