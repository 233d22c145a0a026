"""Whether walls and objects cut a place off, proven on a grid.

A planner that draws samples can only give up; in the plane it can be known. Where one thing is in the way of another
that does not turn, it blocks a convex area, so a cell of the grid is blocked as a whole if its four corners are. Where
no chain of other cells leads from the start to the goal, there is no path.
"""

from __future__ import annotations

from collections.abc import Iterable

import numpy as np
from numpy.typing import NDArray

from llm3.types import Mask, Vector
from llm3_tabletop2d.bodies import Separation
from llm3_tabletop2d.ways import CLEARANCE, EXACT, RESOLUTION, is_free

CELL = 0.015
"""Sides of a cell in metres, at most: there are lines at all edges as well, so that no straight gap is missed."""
MOST_LINES = 500
"""In larger rooms the cells are larger, and less is proven about what is not straight."""
INSIDE = 1e-6
"""How far inside of an edge its line is, in metres."""


class Grid:
    """The places of the robot in one query, in cells."""

    def __init__(self, separation: Separation, low: Vector, high: Vector) -> None:
        """Lay the grid.

        Args:
            separation: Of what moves from what stands.
            low: The smallest x and y of the robot's centre.
            high: The largest.
        """
        self._separation = separation
        self._boxes = list(separation.boxes(CLEARANCE))
        edges = [(least + INSIDE, most - INSIDE) for least, most in self._boxes]
        self._lines = [
            _lines(float(low[axis]), float(high[axis]), [float(p[axis]) for pair in edges for p in pair])
            for axis in (0, 1)
        ]
        """The coordinates of the grid's lines, along x and along y."""
        self._shape = tuple(len(lines) - 1 for lines in self._lines)
        self._cells, self._pairs = self._blocked()

    def joins(self, start: Vector, goal: Vector, without: str = "") -> bool:
        """Whether there may be a path from one point to another, both free; if not, there is certainly none.

        Args:
            start: Where it begins, (2,).
            goal: Where it ends, (2,).
            without: The name of a body that is thought away.
        """
        kept = np.array([other.name != without for _, other in self._separation.pairs])
        free = np.ones(self._shape, dtype=bool)
        free.flat[self._cells[kept[self._pairs]]] = False
        begin, end = self._index(start), self._index(goal)
        free[begin] = free[end] = True
        reached = np.zeros_like(free)
        reached[begin] = True
        runs = _runs(free), _runs(free.T).T
        while not reached[end]:
            before = int(reached.sum())
            for run in runs:  # all free cells of a row, or a column, that touch are reached at once
                hit = np.zeros(int(run.max()) + 1, dtype=bool)
                hit[run[reached]] = True
                reached |= hit[run] & free
            if int(reached.sum()) == before:
                return False
        return True

    def _index(self, point: Vector) -> tuple[int, int]:
        i, j = (
            min(max(int(np.searchsorted(lines, p, side="right")) - 1, 0), len(lines) - 2)
            for lines, p in zip(self._lines, point.tolist(), strict=True)
        )
        return i, j

    def _blocked(self) -> tuple[NDArray[np.intp], NDArray[np.intp]]:
        """Which cells are blocked by which pairs of bodies: the numbers of both, (E,)."""
        nodes: list[tuple[int, NDArray[np.intp], NDArray[np.intp]]] = []
        for pair, (least, most) in enumerate(self._boxes):
            i, j = (
                np.arange(np.searchsorted(lines, least[axis]), np.searchsorted(lines, most[axis], side="right"))
                for axis, lines in enumerate(self._lines)
            )
            if len(i) > 1 and len(j) > 1:
                nodes.append((pair, i, j))
        cells, pairs = [np.empty(0, dtype=np.intp)], [np.empty(0, dtype=np.intp)]
        if nodes:
            x, y = self._lines
            points = [np.stack(np.meshgrid(x[i], y[j], indexing="ij"), axis=-1).reshape(-1, 2) for _, i, j in nodes]
            numbers = np.repeat([pair for pair, _, _ in nodes], [len(p) for p in points])
            deep = self._separation.gaps_of(np.concatenate(points), numbers, CLEARANCE) < CLEARANCE - EXACT
            ends = np.cumsum([len(p) for p in points])[:-1]
            for (pair, i, j), inside in zip(nodes, np.split(deep, ends), strict=True):
                hit = inside.reshape(len(i), len(j))
                u, v = (hit[1:, 1:] & hit[1:, :-1] & hit[:-1, 1:] & hit[:-1, :-1]).nonzero()
                cells.append(np.asarray(i[u] * self._shape[1] + j[v], dtype=np.intp))
                pairs.append(np.full(len(u), pair, dtype=np.intp))
        return np.concatenate(cells), np.concatenate(pairs)


def cut_off(
    separation: Separation, low: Vector, high: Vector, start: Vector, goal: Vector, movable: Iterable[str]
) -> tuple[str, ...] | None:
    """What keeps the robot from getting from one free point to another; None if there may be a path.

    Args:
        separation: Of what moves from what stands.
        low: The smallest x and y of the robot's centre.
        high: The largest.
        start: Where it is.
        goal: Where it is to go.
        movable: The names of bodies that can be moved.

    Returns:
        Those of the movable ones without each of which there may be a path; empty if no single one is to blame.
    """
    if _straight(separation, start, goal).all():
        return None
    grid = Grid(separation, low, high)
    if grid.joins(start, goal):
        return None
    return tuple(name for name in movable if grid.joins(start, goal, without=name))


def _straight(separation: Separation, start: Vector, goal: Vector) -> Mask:
    steps = max(1, int(np.ceil(float(np.abs(goal - start).sum()) / RESOLUTION)))
    return is_free(separation, np.linspace(start, goal, steps + 1))


def _runs(free: Mask) -> NDArray[np.intp]:
    """A number for each stretch of free cells in a row; other cells have numbers of their own."""
    change = np.ones(free.shape, dtype=np.intp)
    change[:, 1:] = ~(free[:, 1:] & free[:, :-1])
    return np.asarray(change.cumsum().reshape(free.shape), dtype=np.intp)


def _lines(low: float, high: float, edges: list[float]) -> Vector:
    """Where the lines of a grid are along an axis: evenly, and at the edges that lie between."""
    count = min(int(np.ceil((high - low) / CELL)), MOST_LINES) + 1
    even = np.linspace(low, high, max(count, 2))
    return np.unique(np.concatenate([even, [edge for edge in edges if low < edge < high]]))
