"""Spots in a place that are so far apart that what stands in one is never in the way of the hand at another."""

from __future__ import annotations

from llm3_bullet.tabletop.rectangles import Point, Rectangle

WORKTOP_PITCH = (0.09, 0.15)
"""From slot to slot on the worktop, in metres, for whatever is taken along y: half of the hand, which is 0.208 m wide
along y and 0.063 m along x, and half of what stands in the next slot."""


def slots(area: Rectangle, counts: tuple[int, int], pitch: Point) -> list[Point]:
    """Centres of slots in rows and columns, around the middle of a place.

    Args:
        area: The place.
        counts: How many there are along x and y.
        pitch: From one to the next along x and y, in metres.
    """
    x, y = (
        [center + step * (index - (count - 1) / 2) for index in range(count)]
        for center, count, step in zip(area.center, counts, pitch, strict=True)
    )
    return [(across, along) for along in y for across in x]
