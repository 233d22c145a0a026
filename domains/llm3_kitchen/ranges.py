"""Where things fit into the places: ranges for whoever draws parameters."""

from __future__ import annotations

from math import pi

from llm3.interfaces import Regions
from llm3_bullet.scene import Size
from llm3_kitchen.actions import PLACE
from llm3_kitchen.instance import KitchenInstance, PlaceSpec

INSET = 0.0005
"""Things are kept this far inside of a place, in metres: ranges and poses are rounded."""
QUARTER = round(pi / 2, 4)
Range = tuple[float, float]


def regions(instance: KitchenInstance) -> Regions:
    """For each thing and place the centres at which the thing fits into the place, with its sides along those of it.

    It is turned by a quarter where it does not fit otherwise; where it does not fit at all, its centre is that of the
    place.
    """
    return {
        (PLACE.name, (thing.name, place.name), parameter): range_
        for thing in instance.things
        for place in instance.places
        for parameter, range_ in _ranges(thing.size, place).items()
    }


def _ranges(size: Size, place: PlaceSpec) -> dict[str, Range]:
    turned = size[0] > place.size[0] or size[1] > place.size[1]
    covers = (size[1], size[0]) if turned else (size[0], size[1])
    x, y = (_inset(place.center[axis], place.size[axis], covers[axis]) for axis in (0, 1))
    theta = QUARTER if turned else 0.0
    return {"x": x, "y": y, "theta": (theta, theta)}


def _inset(center: float, side: float, width: float) -> Range:
    room = max(0.0, (side - width) / 2 - INSET)
    return center - room, center + room
