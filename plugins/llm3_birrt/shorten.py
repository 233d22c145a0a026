"""Shorter paths by shortcuts."""

from __future__ import annotations

from collections.abc import Callable

import numpy as np
from numpy.typing import NDArray

from llm3.interfaces.free_space import bisection_order
from llm3.types import Vector
from llm3_birrt.joint_space import JointSpace

MAX_ROUNDS = 12
"""Rounds of shortcuts at most."""
MAX_MISSES = 2
"""Rounds in a row without a shortcut after which the path is taken as short."""
MIN_GAIN = 0.05
"""A shortcut saves at least this fraction of the path, or it is none."""
POINTS = 8
"""Random points of the path, besides its waypoints, that the shortcuts of a round may join."""
CANDIDATES = 16
"""Shortcuts that are probed in a round."""
PROBES = 3
"""Samples of each that are tested at first, all of a round in one batch."""
TRIALS = 3
"""Shortcuts that are tested to the end in a round, at most."""


def shorten(
    path: Vector, space: JointSpace, rng: np.random.Generator, in_time: Callable[[], bool] = lambda: True
) -> Vector:
    """A path with the same ends that is no longer than `path`, shape (N, dof); its edges are free.

    Each round draws points of the path, probes shortcuts between them and the waypoints with a few samples each, and
    takes the one that saves most. It ends once the path is about as short as the straight line, or nothing is gained.

    Args:
        path: Waypoints (N, dof) that are joined by free edges.
        space: The joint space.
        rng: The only source of randomness.
        in_time: Asked before each round; once it answers False, the path is returned as it is.

    Source: R. Geraerts and M. H. Overmars, "Creating high-quality paths for motion planning", IJRR 26(8), 2007.
    """
    misses = 0
    shortest = float(np.linalg.norm(path[-1] - path[0]))
    for _ in range(MAX_ROUNDS):
        length = float(_reached(path)[-1])
        if length - shortest <= MIN_GAIN * length or misses == MAX_MISSES or not in_time():
            break
        shorter = _shortcut(path, space, rng)
        misses = misses + 1 if shorter is None else 0
        path = path if shorter is None else shorter
    return path


def _shortcut(path: Vector, space: JointSpace, rng: np.random.Generator) -> Vector | None:
    """The path with the best shortcut of a round that is free; None if there is none."""
    reached = _reached(path)
    points, positions = _points(path, reached, space, rng)
    first, last = np.triu_indices(len(points), 1)
    saved = positions[last] - positions[first] - np.linalg.norm(points[last] - points[first], axis=1)
    best_first = np.argsort(-saved, kind="stable")
    best_first = best_first[saved[best_first] > MIN_GAIN * reached[-1]]
    if not len(best_first):
        return None
    # Those that save most are blocked most: the candidates come from the whole range.
    chosen = best_first[np.linspace(0, len(best_first) - 1, min(CANDIDATES, len(best_first))).astype(int)]
    first, last = first[chosen], last[chosen]
    for i in _may_be_free(points[first], points[last], space)[:TRIALS]:
        leave, enter = first[i], last[i]
        if space.obstacle(points[leave], points[enter]) is None:
            before, after = path[reached < positions[leave]], path[reached > positions[enter]]
            return np.vstack([before, points[leave], points[enter], after])
    return None


def _points(path: Vector, reached: Vector, space: JointSpace, rng: np.random.Generator) -> tuple[Vector, Vector]:
    """The waypoints and some random points between them, in order, shape (N, dof), and how far along they are, (N,).

    They are samples that were tested when the path was found, so what a shortcut leaves of an edge is free.
    """
    edges = np.searchsorted(reached, rng.uniform(0.0, reached[-1], size=POINTS), side="right") - 1
    edges = np.clip(edges, 0, len(path) - 2)
    steps = np.array([space.steps(path[edge], path[edge + 1]) for edge in edges])
    at = np.floor(rng.uniform(size=POINTS) * steps) / steps
    between = path[edges] * (1 - at[:, None]) + path[edges + 1] * at[:, None]
    positions = np.concatenate([reached, reached[edges] * (1 - at) + reached[edges + 1] * at])
    order = np.argsort(positions, kind="stable")
    return np.vstack([path, between])[order], positions[order]


def _may_be_free(starts: Vector, ends: Vector, space: JointSpace) -> NDArray[np.int64]:
    """Which of the straight lines between configurations (N, dof) are free at a few samples each."""
    open_ = np.arange(len(starts))
    for number in bisection_order(PROBES + 1):  # one of each line at a time: what is blocked once is not asked again
        if not len(open_):
            break
        weight = number / (PROBES + 1)
        open_ = open_[space.free(starts[open_] * (1 - weight) + ends[open_] * weight)]
    return open_


def _reached(path: Vector) -> Vector:
    """How far along the path its waypoints are, shape (N,)."""
    return np.concatenate([[0.0], np.linalg.norm(np.diff(path, axis=0), axis=1).cumsum()])
