"""Fills the store: food with room for fingers between, and clutter that takes that room away again."""

from __future__ import annotations

from collections.abc import Mapping
from math import cos, sin

import numpy as np

from llm3_bullet.scene import Size
from llm3_bullet.tabletop.rectangles import Point, Rectangle

FINGER_ROOM = 0.032
"""Between any two foods, and between any two things of the clutter: room for a finger, in metres."""
SNUG = (0.003, 0.008)
"""From food to what blocks it, in metres."""
ASIDE = 0.01
"""How far the middle of what blocks food is from being opposite to the food's middle, in metres."""
MOST_TURNED = 0.25
"""How far things in the store are turned, in radians."""
TRIES = 40
"""How many spots are tried for a thing before the store is filled anew."""
Spot = tuple[Point, float]
"""x, y in metres, and a yaw in radians."""


def filled(
    area: Rectangle, foods: Mapping[str, Size], clutter: Mapping[str, Size], rng: np.random.Generator
) -> dict[str, Spot]:
    """Where everything starts.

    Food that is longer than wide is taken by its long sides. The first such food has the first thing of the clutter
    close to one of these, the second one the second, and so on; what is left over stands anywhere.

    Args:
        area: The store.
        foods: Sizes by name.
        clutter: Sizes by name; all higher than the food, so that the hand can take these first.
        rng: Draws the spots.
    """
    while True:
        spots = _drawn(area, foods, clutter, rng)
        if spots:
            return spots


def _drawn(
    area: Rectangle, foods: Mapping[str, Size], clutter: Mapping[str, Size], rng: np.random.Generator
) -> dict[str, Spot] | None:
    """Spots for all; None where one was not found."""
    spots: dict[str, Spot] = {}
    standing: dict[str, Rectangle] = {}
    sizes = {**foods, **clutter}
    long = (name for name, size in foods.items() if size[0] > size[1])
    blocked = dict(zip(clutter, long, strict=False))
    in_pairs = [name for obstacle, food in blocked.items() for name in (food, obstacle)]
    for name in dict.fromkeys((*in_pairs, *sizes)):
        size, alike = sizes[name], foods if name in foods else clutter
        for _ in range(TRIES):
            food = blocked.get(name)
            spot = _beside(*spots[food], sizes[food], size, rng) if food else _any(area, size, rng)
            covered = footprint(spot, size)
            if area.overhang(covered) == 0.0 and not any(
                _wider(covered, FINGER_ROOM if other in alike else SNUG[0]).overlaps(rectangle)
                for other, rectangle in standing.items()
            ):
                spots[name], standing[name] = spot, covered
                break
        else:
            return None
    return spots


def _any(area: Rectangle, size: Size, rng: np.random.Generator) -> Spot:
    rooms = ((side - width) / 2 for side, width in zip(area.size, size, strict=False))
    x, y = (rng.uniform(center - room, center + room) for center, room in zip(area.center, rooms, strict=True))
    return rounded(x, y, rng.uniform(-MOST_TURNED, MOST_TURNED))


def _beside(center: Point, yaw: float, long: Size, size: Size, rng: np.random.Generator) -> Spot:
    """Close to one of the long sides of something, and turned like it."""
    across = rng.choice((-1.0, 1.0)) * (rng.uniform(*SNUG) + (long[1] + size[1]) / 2)
    along = rng.uniform(-ASIDE, ASIDE)
    return rounded(
        center[0] + along * cos(yaw) - across * sin(yaw), center[1] + along * sin(yaw) + across * cos(yaw), yaw
    )


def rounded(x: float, y: float, yaw: float) -> Spot:
    """A spot to the millimetre and the milliradian."""
    return (round(float(x), 3), round(float(y), 3)), round(float(yaw), 3)


def footprint(spot: Spot, size: Size) -> Rectangle:
    """What a thing of this size covers at a spot."""
    center, yaw = spot
    return Rectangle(center, (size[0], size[1]), (cos(yaw), sin(yaw)))


def _wider(rectangle: Rectangle, room: float) -> Rectangle:
    """With this much room around it, in metres."""
    width, depth = rectangle.size
    return Rectangle(rectangle.center, (width + 2 * room, depth + 2 * room), rectangle.direction)
