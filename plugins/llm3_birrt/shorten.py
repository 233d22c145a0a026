"""Shorter paths by shortcuts."""

from __future__ import annotations

from collections.abc import Callable

import numpy as np

from llm3.types import Vector
from llm3_birrt.free_space import FreeSpace

MAX_SHORTCUTS = 50
"""Random shortcuts that are tried at most."""
MAX_MISSES = 10
"""Random shortcuts in a row without a gain after which the path is taken as short."""
MIN_GAIN = 0.01
"""A shortcut that saves less than this fraction of the path counts as a miss; it is taken all the same."""


def shorten(
    path: Vector, space: FreeSpace, rng: np.random.Generator, in_time: Callable[[], bool] = lambda: True
) -> Vector:
    """A path with the same ends that is no longer than `path`, shape (N, dof); its edges are free.

    Random shortcuts between points anywhere on the path, then waypoints left out where the way without them is free.

    Args:
        path: Waypoints (N, dof) that are joined by free edges.
        space: The free space.
        rng: The only source of randomness.
        in_time: Asked before each shortcut; once it answers False, the path is returned as it is.

    Source: R. Geraerts and M. H. Overmars, "Creating high-quality paths for motion planning", IJRR 26(8), 2007.
    """
    misses = 0
    for _ in range(MAX_SHORTCUTS):
        if len(path) < 3 or misses == MAX_MISSES or not in_time():
            break
        shorter = _shortcut(path, space, rng)
        misses = 0 if _length(shorter) < (1 - MIN_GAIN) * _length(path) else misses + 1
        path = shorter
    return _without_detours(path, space, in_time)


def _shortcut(path: Vector, space: FreeSpace, rng: np.random.Generator) -> Vector:
    """Join two random points of the path, or leave it as it is where that is not free."""
    reached = np.concatenate([[0.0], np.linalg.norm(np.diff(path, axis=0), axis=1).cumsum()])
    positions = np.sort(rng.uniform(0.0, reached[-1], size=2))
    first, last = np.clip(np.searchsorted(reached, positions, side="right") - 1, 0, len(path) - 2)
    if first == last:
        return path
    leave, enter = (
        space.step(path[edge], path[edge + 1], position - reached[edge])
        for edge, position in zip((first, last), positions, strict=True)
    )
    # The remaining pieces of the two edges were tested as parts of longer edges, at other samples: test them anew.
    pieces = ((leave, enter), (path[first], leave), (enter, path[last + 1]))
    if not all(space.edge(start, end) for start, end in pieces):
        return path
    return np.vstack([path[: first + 1], leave, enter, path[last + 1 :]])


def _without_detours(path: Vector, space: FreeSpace, in_time: Callable[[], bool]) -> Vector:
    """From each waypoint go straight to the last one that is in free sight."""
    kept, here = [0], 0
    while here < len(path) - 1:
        farther = range(len(path) - 1, here + 1, -1)
        here = next((i for i in farther if in_time() and space.edge(path[here], path[i])), here + 1)
        kept.append(here)
    return path[kept]


def _length(path: Vector) -> float:
    return float(np.linalg.norm(np.diff(path, axis=0), axis=1).sum())
