"""Problems in the unit square: random discs, and a wall with a gap."""

from __future__ import annotations

from collections.abc import Callable, Sequence

import numpy as np

from llm3.interfaces import PlannerSettings
from llm3.types import Contact, Failure, Goal, Mask, MotionProblem, Path, Vector
from llm3_ompl import plugin

RESOLUTION = 0.05
"""Metres. Where every sample is this far from a disc, no point between two samples is inside it."""
FACTORIES = plugin.llm3_planners()
NAMES = sorted(FACTORIES)
LEFT, RIGHT = (0.2, 0.2), (0.8, 0.2)
Point = tuple[float, float]
Disc = tuple[float, float, float]


def inflated_by(margin: float, discs: Sequence[Disc]) -> Callable[[Vector], Mask]:
    """The validity of points (N, 2) that have to stay this far from all discs (x, y, radius)."""
    world = np.array(discs).reshape(-1, 3)

    def valid(points: Vector) -> Mask:
        distances = np.linalg.norm(points[:, None] - world[:, :2], axis=2)
        return (distances > world[:, 2] + margin).all(axis=1)

    return valid


def among_discs(start: Point, goals: Sequence[Point], discs: Sequence[Disc]) -> MotionProblem:
    """From the start to a goal, farther than the resolution from every disc."""

    def explain(point: Vector) -> tuple[Contact, ...]:
        depths = (r + RESOLUTION - float(np.hypot(x - point[0], y - point[1])) for x, y, r in discs)
        return tuple(Contact("point", f"disc {i}", depth) for i, depth in enumerate(depths) if depth >= 0)

    return in_square(inflated_by(RESOLUTION, discs), *goals, start=start, resolution=RESOLUTION, explain=explain)


def barrier(gap: int) -> list[Disc]:
    """A row of discs across the square at x = 0.5, with a gap that is the higher the larger the number (0 to 6)."""
    return [(0.5, 0.14 * i, 0.03) for i in range(8) if i not in (gap, gap + 1)]


def in_square(valid: Callable[[Vector], Mask], *goals: Point, start: Point = LEFT, **others) -> MotionProblem:
    """A problem in the unit square; one goal to the right if none is given."""
    fields = {"resolution": 0.01, "low": np.zeros(2), "high": np.ones(2)} | others
    return MotionProblem(np.array(start), tuple(map(Goal, goals or (RIGHT,))), valid=valid, **fields)


def wall(gap_low: float, gap_high: float) -> Callable[[Vector], Mask]:
    """A wall across the square at x = 0.45 .. 0.55, with a gap in y."""

    def valid(points: Vector) -> Mask:
        x, y = points[:, 0], points[:, 1]
        return (x < 0.45) | (x > 0.55) | ((y > gap_low) & (y < gap_high))

    return valid


def plan(name: str, problem: MotionProblem, seed: int = 0, iterations: int = 300, **settings) -> Path | Failure:
    """One query; nothing but its iterations limit it."""
    limits = PlannerSettings(**{"max_iterations": iterations, "max_seconds": np.inf} | settings)
    return FACTORIES[name](limits).plan(problem, np.random.default_rng(seed))


def sampled(path: Path, resolution: float) -> Vector:
    """Points along the path, no further apart than the resolution allows."""
    pieces = []
    for a, b in zip(path.waypoints[:-1], path.waypoints[1:], strict=True):
        steps = max(1, int(np.ceil(np.abs(b - a).sum() / resolution)))
        pieces.append(a + (b - a) * np.linspace(0.0, 1.0, steps + 1)[:, None])
    return np.vstack(pieces)
