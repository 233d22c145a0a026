"""Configurations to ask a validity test about."""

from __future__ import annotations

from collections.abc import Iterable
from itertools import islice
from typing import Any

import numpy as np

from llm3.types import MotionProblem, Vector

WIDE = 100.0
GOALS = 3
"""How many goals of a motion problem are looked at: they may be dear to make."""
ALONG = 8
"""How many configurations are looked at on each line from the start to a goal."""
NEAR = (1.0, 4.0, 8.0, 16.0)
"""How far from starts, goals and other places of interest, in multiples of the resolution."""
CLOSE = 8
"""How many more configurations are looked at, at each of these distances, about the first goal."""
EDGES, HALVINGS = 6, 10
"""How many places are looked for where the verdict changes, and how often the way to each is halved."""


def some_goals(problem: MotionProblem) -> list[Any]:
    """The first goals of a motion problem."""
    return list(islice(problem.goals, GOALS))


def samples(problem: MotionProblem, count: int = 24) -> Vector:
    """Configurations to ask about, the same for equal problems: the start, some goals, and others within the limits."""
    ends = [problem.start, *(np.array(goal.configuration) for goal in some_goals(problem))]
    low, high = _bounds(problem)
    drawn = np.random.default_rng(0).uniform(low, high, size=(count, len(problem.start)))
    return np.vstack([*ends, drawn])


def malformed(problem: MotionProblem) -> str:
    """What the validity test answers instead of one truth value a configuration; empty if it answers as it should."""
    at = samples(problem)
    mask = problem.valid(at.copy())
    if isinstance(mask, np.ndarray) and mask.shape == (len(at),) and mask.dtype == bool:
        return ""
    shown = f"{mask.dtype} {mask.shape}" if isinstance(mask, np.ndarray) else f"{mask!r:.60}"
    return f"{shown} for configurations of shape {at.shape}"


def places(problems: Iterable[MotionProblem]) -> list[Vector]:
    """Where something is done: starts, goals, and the ends of the pieces that follow them; each once."""
    found: dict[bytes, Vector] = {}
    for problem in problems:
        goals = some_goals(problem)
        ends = [problem.start, *(np.array(goal.configuration) for goal in goals)]
        ends += [np.array(w, dtype=float) for g in goals for s in g.then for w in (s.waypoints[0], s.waypoints[-1])]
        found.update((q.tobytes(), q) for q in ends if q.shape == problem.start.shape)
    return list(found.values())


def telling(problem: MotionProblem, others: Iterable[Vector]) -> Vector:
    """Configurations at which even a small obstacle shows that is elsewhere at another time.

    Args:
        problem: What is asked about.
        others: Places of interest, such as where things are taken and put in other problems.
    """
    rng, low, high = np.random.default_rng(0), *_bounds(problem)
    own = places((problem,))
    lines = [
        problem.start + step * (np.array(goal.configuration) - problem.start)
        for goal in some_goals(problem)
        for step in np.linspace(0, 1, ALONG + 2)[1:-1]
    ]
    of_interest = [*own, *(q for q in others if q.shape == problem.start.shape)]
    goal = np.array(problem.goals[0].configuration)
    centres = np.vstack([*of_interest, *[goal] * CLOSE])
    around = [centres + far * problem.resolution * rng.uniform(-1, 1, size=centres.shape) for far in NEAR]
    at = np.clip(np.vstack([samples(problem), *lines, *of_interest, *around]), low, high)
    return np.vstack([at, _edges(problem, at, rng)])


def _edges(problem: MotionProblem, at: Vector, rng: np.random.Generator) -> Vector:
    """Pairs of configurations, one free and one blocked and close together: the edges of what is in the way."""
    mask = np.asarray(problem.valid(at.copy()), dtype=bool)
    free, blocked = at[mask], at[~mask]
    if not len(free) or not len(blocked):
        return at[:0]
    inside = blocked[rng.permutation(len(blocked))[:EDGES]]
    low, high = _bounds(problem)
    distances = np.abs((inside[:, None] - free[None]) / np.maximum(high - low, 1e-9)).sum(axis=2)
    outside = free[distances.argmin(axis=1)]
    for _ in range(HALVINGS):
        middle = (inside + outside) / 2
        is_free = np.asarray(problem.valid(middle.copy()), dtype=bool)[:, None]
        inside, outside = np.where(is_free, inside, middle), np.where(is_free, middle, outside)
    return np.vstack([inside, outside])


def _bounds(problem: MotionProblem) -> tuple[Vector, Vector]:
    """The limits; another rule refuses endless ones."""
    return np.clip(problem.low, -WIDE, WIDE), np.clip(problem.high, -WIDE, WIDE)
