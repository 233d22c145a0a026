"""The fixed things of the scene."""

from __future__ import annotations

from collections.abc import Iterable, Iterator

from llm3.types import Pose
from llm3_bullet.scene import Box
from llm3_bullet.tabletop.table import Surface, table
from llm3_kitchen.instance import RIM_THICKNESS, PlaceSpec

PLATE_HEIGHT = 0.01
"""Of the plate that is a stove, in metres."""
RIM_HEIGHT = 0.02
"""Of the rim around a sink, in metres; its floor is the table."""


def furniture(places: Iterable[PlaceSpec]) -> tuple[Box, ...]:
    """The table, the stoves' plates and the sinks' rims; other places are only marked on the table."""
    return (table(), *(box for place in places for box in _fixture(place)))


def surfaces(places: Iterable[PlaceSpec]) -> tuple[Surface, ...]:
    """Where things stand higher than on the table."""
    return tuple(Surface(place.area, PLATE_HEIGHT) for place in places if place.kind == "stove")


def _fixture(place: PlaceSpec) -> Iterator[Box]:
    (x, y), (dx, dy) = place.center, place.size
    if place.kind == "stove":
        yield Box(place.name, (dx, dy, PLATE_HEIGHT), Pose((x, y, PLATE_HEIGHT / 2)), fixed=True)
    if place.rim:
        z, t = RIM_HEIGHT / 2, RIM_THICKNESS
        pieces = (
            ((t, dy + 2 * t), (x - (dx + t) / 2, y)),
            ((t, dy + 2 * t), (x + (dx + t) / 2, y)),
            ((dx, t), (x, y - (dy + t) / 2)),
            ((dx, t), (x, y + (dy + t) / 2)),
        )
        for name, (size, center) in zip(place.rim, pieces, strict=True):
            yield Box(name, (*size, RIM_HEIGHT), Pose((*center, z)), fixed=True)
