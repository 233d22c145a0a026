"""Where to put an object, for the stand-in."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np
from numpy.typing import NDArray

from llm3_tabletop2d.table import Area, Span, Table, Thing

Spots = NDArray[np.float64]
"""x, y of centres, (N, 2)."""
SAMPLES = 1000
JITTER = 0.005
"""Metres by which equally good spots differ at random, as long as all goes well."""
GAP = 0.007
"""Free space beside an object in its region that is wished for, in metres."""
ROOMY = 0.09
"""The same where an object is put aside."""
FAR = 0.1
"""Free space between where an object was and where it is put aside, in metres."""
SAME_SPOT = 0.01
"""A spot this close to one that failed, in metres, is not tried again."""


def spot_in(table: Table, thing: Thing, tried: Sequence[Span], jitter: float, rng: np.random.Generator) -> Span:
    """A spot in the object's region: at the far end, as it comes, and close to an edge or to what is there already.

    Args:
        table: What stands where.
        thing: The object, which belongs in a region.
        tried: Where it could not be put.
        jitter: Metres by which equally good spots differ at random.
        rng: Chooses among good spots.
    """
    if thing.region is None:
        raise ValueError(f"{thing.name} belongs nowhere")
    region = table.regions[thing.region]
    centers = [(low + high) / 2 for low, high in region]
    way = (centers[0] - thing.x, centers[1] - thing.y)
    along = 0 if abs(way[0]) >= abs(way[1]) else 1
    across = 1 - along
    sign = 1.0 if way[along] >= 0 else -1.0
    spots = _roomy(_fresh(_draw(region, thing, rng), tried), thing, table.others(thing), GAP)
    edge = np.abs(spots[:, across, None] - np.array(region[across])).min(axis=1) - thing.extent[across] / 2
    return _best(spots, -sign * spots[:, along] + edge / 2 + rng.uniform(0.0, jitter, len(spots)))


def aside(table: Table, thing: Thing, tried: Sequence[Span], rng: np.random.Generator) -> Span:
    """A spot where the object is in nobody's way: away from everything and from all regions, and near the robot.

    Args:
        table: What stands where.
        thing: The object.
        tried: Where it could not be put.
        rng: Chooses among good spots.
    """
    spots = _fresh(_draw(table.room, thing, rng), tried)
    spots = _roomy(spots, thing, [thing.area], FAR)
    spots = _roomy(spots, thing, [*table.others(thing), *table.regions.values()], ROOMY)
    way = np.linalg.norm(spots - table.robot, axis=1) + np.linalg.norm(spots - (thing.x, thing.y), axis=1)
    return _best(spots, way + rng.uniform(0.0, 0.2, len(spots)))


def _draw(area: Area, thing: Thing, rng: np.random.Generator) -> Spots:
    """Centres at which the object lies in the area, or in its middle if it is too large, (N, 2)."""
    low, high = np.array(area).T
    middle, room = (low + high) / 2, np.maximum(0.0, high - low - thing.extent) / 2
    return np.round(rng.uniform(middle - room, middle + room, (SAMPLES, 2)), 3)


def _fresh(spots: Spots, tried: Sequence[Span]) -> Spots:
    """Those that are not close to one that was tried; all of them if none is left."""
    if not tried:
        return spots
    distances = np.linalg.norm(spots[:, None] - np.array(tried), axis=2)
    fresh = spots[(distances > SAME_SPOT).all(axis=1)]
    return fresh if len(fresh) else spots


def _roomy(spots: Spots, thing: Thing, others: Sequence[Area], gap: float) -> Spots:
    """Those with free space on all sides; where there are none, those with as much as there is."""
    if not others:
        return spots
    low, high = np.array(others).transpose(2, 0, 1)
    half = np.array(thing.extent) / 2
    space = np.maximum(low - (spots + half)[:, None], (spots - half)[:, None] - high).max(axis=2).min(axis=1)
    return np.asarray(spots[space >= min(gap, float(space.max()))])


def _best(spots: Spots, cost: NDArray[np.float64]) -> Span:
    x, y = spots[int(cost.argmin())]
    return float(x), float(y)
