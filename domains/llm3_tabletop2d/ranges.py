"""Tighter ranges for random sampling than the room."""

from __future__ import annotations

from llm3.interfaces import Regions
from llm3_tabletop2d.actions import PLACE, PUSH, is_taken
from llm3_tabletop2d.instance import Pair, TabletopInstance


def regions(instance: TabletopInstance) -> Regions:
    """Where the centre of each object can be: in its region if it belongs in one, or in the room.

    What belongs where something else starts may be pushed anywhere, to be out of the way.
    """
    ranges: dict[tuple[str, tuple[str, ...], str], Pair] = {}
    for item in instance.objects:
        region = instance.region_of(item.name)
        room = ((0.0, instance.room[0]), (0.0, instance.room[1]))
        for action in (PLACE, PUSH):
            home = action == PLACE or not is_taken(instance, item)
            area = region.ranges if region and home else room
            for axis, span, length in zip("xy", area, item.extent(item.theta), strict=True):
                ranges[action, (item.name,), axis] = _inset(span, length)
    return ranges


def _inset(span: Pair, length: float) -> Pair:
    """Where in a span the centre of something of this length can be; the middle if it is too long."""
    middle, room = (span[0] + span[1]) / 2, max(0.0, span[1] - span[0] - length) / 2
    return middle - room, middle + room
