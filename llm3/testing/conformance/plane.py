"""A family of small worlds in the plane, in which a planner has to show what it can do."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass

import numpy as np

from llm3.types import Contact, FailureKind, Goal, Mask, MotionProblem, Vector

Rectangle = tuple[float, float, float, float]
"""x from, x to, y from, y to."""
MOST_TESTS = 2_000_000
"""How many configurations may be asked about in one query; whoever asks for more does not keep to a budget."""
RESOLUTION = 0.02


class NoEnd(Exception):  # it ends a search that would not, and no caller sees it
    """A planner goes on and on."""


@dataclass(frozen=True)
class Case:
    """A problem, and what may come of it."""

    name: str
    start: tuple[float, float]
    goals: tuple[tuple[float, float], ...]
    walls: tuple[Rectangle, ...] = ()
    failure: FailureKind | None = None
    """How it fails; None if there is a path."""
    blamed: str = ""
    """What is in the way where it fails."""

    def problem(self, count: Callable[[int], None] = lambda _: None) -> MotionProblem:
        """The problem, anew; `count` is told of the configurations that are tested, and may end it."""

        def valid(points: Vector) -> Mask:
            count(len(points))
            return self.free(points, 0.0)

        def explain(point: Vector) -> tuple[Contact, ...]:
            return tuple(
                Contact("point", f"wall {number}", 0.01)
                for number, wall in enumerate(self.walls)
                if bool(_inside(point[None], wall, 0.0)[0])
            )

        return MotionProblem(
            np.array(self.start),
            tuple(map(Goal, self.goals)),
            np.zeros(2),
            np.ones(2),
            valid,
            np.full(2, RESOLUTION),
            explain=explain,
        )

    def free(self, points: Vector, shrunk: float) -> Mask:
        """Which points (N, 2) are in no wall, each of which is made smaller by so much on every side."""
        blocked = [_inside(points, wall, shrunk) for wall in self.walls]
        return ~np.any(blocked, axis=0) if blocked else np.ones(len(points), dtype=bool)


def _inside(points: Vector, wall: Rectangle, shrunk: float) -> Mask:
    x, y = points[:, 0], points[:, 1]
    left, right, bottom, top = wall
    inside = (x > left + shrunk) & (x < right - shrunk) & (y > bottom + shrunk) & (y < top - shrunk)
    return np.asarray(inside, dtype=bool)


_LEFT, _RIGHT, _MIDDLE = (0.2, 0.5), (0.8, 0.5), (0.5, 0.5)
_BLOCK = ((0.45, 0.55, 0.2, 0.8),)
_GAP = ((0.45, 0.55, -1.0, 0.62), (0.45, 0.55, 0.74, 2.0))
_FULL = ((0.45, 0.55, -1.0, 2.0),)
CASES = (
    Case("free", _LEFT, (_RIGHT,)),
    Case("already there", _LEFT, (_LEFT,)),
    Case("along the limits", (0.0, 0.0), ((1.0, 0.0),)),
    Case("around a block", _LEFT, (_RIGHT,), _BLOCK),
    Case("around a block that leaves no way but at the limits", _LEFT, (_RIGHT,), ((0.4, 0.6, 0.1, 0.96),)),
    Case("through a gap", _LEFT, (_RIGHT,), _GAP),
    Case("many goals, the first in collision", _LEFT, (_MIDDLE, (0.8, 0.2), (0.8, 0.8)), _BLOCK),
    Case("start in collision", _MIDDLE, (_RIGHT,), _BLOCK, FailureKind.START_IN_COLLISION, "wall 0"),
    Case("all goals in collision", _LEFT, (_MIDDLE, (0.5, 0.3)), _BLOCK, FailureKind.GOAL_IN_COLLISION, "wall 0"),
    Case("enclosed", _LEFT, (_RIGHT,), _FULL, FailureKind.NO_PATH),
)
