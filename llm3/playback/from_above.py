"""Pictures of what is seen from above, for domains that have no stage of their own."""

from __future__ import annotations

from collections.abc import Callable
from importlib.util import find_spec
from typing import Any

import numpy as np

from llm3.errors import MissingDependency, PluginError
from llm3.guarded import guarded
from llm3.interfaces import Domain, Options, Picture, Stage
from llm3.types import Moment, Shape, State, color_of

View = Callable[[Moment], tuple[Shape, ...]]
"""The outlines of what there is at a moment, seen from above, what lies on top last."""
BACKGROUND, EDGE = (255, 255, 255), (40, 40, 40)
MARGIN = 0.04
"""Around what is shown, as a part of the picture's smaller side."""
OVERSAMPLING = 3
"""Pillow draws edges without smoothing them, so a larger picture is made smaller."""


def seen_from_above(domain: Domain, instance: Any, options: Options, state: State) -> tuple[Shape, ...] | None:
    """The domain's own view; None if it has none.

    Raises:
        PluginError: The domain answers something else.
    """
    shapes = guarded(domain.top_view, (tuple, type(None)), instance, options, state)
    for shape in shapes or ():
        if not isinstance(shape, Shape):
            raise PluginError(f"{type(domain).__name__}.top_view must answer a tuple of Shape, and {shape!r} is none.")
    return shapes


class FromAbove(Stage):
    """Draws outlines with Pillow."""

    def __init__(self, view: View) -> None:
        """Take what answers the outlines of a moment, what lies on top last.

        Raises:
            MissingDependency: Pillow is not installed.
        """
        if find_spec("PIL") is None:
            raise MissingDependency("pictures need Pillow, which is not installed: pip install 'llm3[viz]'.")
        self._view = view
        self._shapes: tuple[Shape, ...] = ()

    def show(self, moment: Moment) -> None:
        """Remember the outlines."""
        self._shapes = self._view(moment)

    def picture(self, width: int, height: int) -> Picture:
        """The outlines, as large as the picture allows; what is fixed decides what is in it, if anything is."""
        from PIL import Image, ImageDraw

        size = width * OVERSAMPLING, height * OVERSAMPLING
        image = Image.new("RGB", size, BACKGROUND)
        draw = ImageDraw.Draw(image)
        in_view = [shape for shape in self._shapes if shape.fixed] or self._shapes
        if in_view:
            corners = np.array([corner for shape in in_view for corner in shape.corners])
            low, high = corners.min(axis=0), corners.max(axis=0)
            room = np.array(size) - 2 * MARGIN * min(size)
            scale = float((room / np.maximum(high - low, 1e-9)).min())
            middle = (low + high) / 2
            for shape in self._shapes:
                x, y = ((np.array(shape.corners) - middle) * scale).T
                points = list(zip((size[0] / 2 + x).tolist(), (size[1] / 2 - y).tolist(), strict=True))
                color = tuple(round(255 * part) for part in shape.color or color_of(shape.name))
                draw.polygon(points, fill=color, outline=EDGE, width=OVERSAMPLING)
        return np.asarray(image.resize((width, height), Image.Resampling.LANCZOS))
