"""Choosing a spot in a place: the rules of thumb of the stand-in."""

from __future__ import annotations

from collections.abc import Iterable

import numpy as np
from numpy.typing import NDArray

from llm3.types import Action
from llm3_kitchen.actions import PLACE
from llm3_kitchen.picture import QUARTER, Pair, Picture, Place, covered

Array = NDArray[np.float64]
EDGE_MARGIN = 0.004
"""Things are put down at least this far inside of a place, in metres."""
STEP = 0.005
"""Spots are looked at this far apart, in metres."""
SAME_SPOT = 0.02
"""A spot closer than this to one that failed, in metres, is not tried again."""
JITTER = 0.02
"""How far chance may outweigh tidiness, in metres."""
SMALLEST_GAP = 0.004
"""Where there is less room than this between things, in metres, a place is full."""
TIDY = ("worktop", "serving", "store")
"""Kinds of places that are filled from a corner; in the others, the middle is best."""


def choose_spot(
    picture: Picture, name: str, where: str, gap: float, failed: Iterable[Pair], rng: np.random.Generator
) -> Action | None:
    """Put something into a place with some room around it, or with less where there is no more; None if it is full.

    Args:
        picture: What stands where.
        name: What is put down.
        where: The place.
        gap: The room that is wished for, in metres.
        failed: Spots at which this did not work, x and y.
        rng: Chooses among good spots.
    """
    place, size = picture.places[where], picture.things[name].size
    thetas = (0.0,) if size[0] == size[1] else (0.0, QUARTER)
    options = np.vstack([_options(place, covered(size, theta), theta) for theta in thetas])
    for x, y in failed:
        options = options[np.hypot(options[:, 0] - x, options[:, 1] - y) > SAME_SPOT]
    room = np.full(len(options), np.inf)
    for spot in picture.spots.values():
        apart = np.abs(options[:, :2] - (spot.x, spot.y)) - (options[:, 3:] + spot.cover) / 2
        room = np.minimum(room, apart.max(axis=1))
    while gap > SMALLEST_GAP:
        good = options[room >= gap]
        if len(good):
            best = good[np.argmin(_untidiness(place, good) + rng.uniform(0.0, JITTER, len(good)))]
            x, y, theta = (round(float(value), 4) for value in best[:3])
            return Action(PLACE.name, (name, where), {"x": x, "y": y, "theta": theta})
        gap *= 0.7
    return None


def _options(place: Place, cover: Pair, theta: float) -> Array:
    """Spots on a grid: x, y, theta and what is covered along x and y, (N, 5)."""
    axes = [
        np.arange(low + width / 2 + EDGE_MARGIN, high - width / 2 - EDGE_MARGIN, STEP)
        for (low, high), width in zip((place.x, place.y), cover, strict=True)
    ]
    x, y = (grid.ravel() for grid in np.meshgrid(*axes))
    return np.column_stack([x, y, np.full(len(x), theta), np.full(len(x), cover[0]), np.full(len(x), cover[1])])


def _untidiness(place: Place, options: Array) -> Array:
    """How far things are from where they are best, in metres: in a corner, or in the middle."""
    if place.kind in TIDY:
        best = np.array((place.x[0], place.y[0])) + options[:, 3:] / 2
    else:
        best = np.array((sum(place.x) / 2, sum(place.y) / 2))
    return np.asarray(np.abs(options[:, :2] - best).sum(axis=1))
