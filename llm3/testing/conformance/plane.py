"""A family of small worlds, most of them in the plane, in which a planner has to show what it can do."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass

import numpy as np

from llm3.types import Contact, FailureKind, Goal, Mask, MotionProblem, Vector

Box = tuple[tuple[float, float], ...]
"""From and to, for each joint."""
Values = tuple[float, ...]
"""One for each joint."""
MARGIN = 5
"""How many steps of the resolution from a wall a world that tells what is certainly free is certain."""


@dataclass(frozen=True)
class Case:
    """A problem, and what may come of it."""

    name: str
    start: Values
    goals: tuple[Values, ...]
    walls: tuple[Box, ...] = ()
    failure: FailureKind | None = None
    """How it fails; None if there is a path."""
    blamed: str = ""
    """What is in the way where it fails."""
    low: Values = (0.0, 0.0)
    high: Values = (1.0, 1.0)
    resolution: Values = (0.02, 0.02)
    like: str = ""
    """The world of which this one is a copy in other limits."""
    tells_uncertain: bool = False
    """Whether the problem says what is certainly free."""

    @property
    def dof(self) -> int:
        """The number of joints."""
        return len(self.start)

    @property
    def straight(self) -> bool:
        """Whether the straight line to some goal is free."""
        steps = np.linspace(0.0, 1.0, 1000)[:, None]
        lines = [np.array(self.start) * (1 - steps) + np.array(goal) * steps for goal in self.goals]
        return any(bool(self.free(line).all()) for line in lines)

    def problem(
        self,
        asked: Callable[[Vector], None] = lambda _: None,
        explained: Callable[[tuple[Contact, ...]], None] = lambda _: None,
    ) -> MotionProblem:
        """The problem, anew.

        Args:
            asked: Is told of the configurations (N, dof) that are tested, and may end it.
            explained: Is told of what explains a configuration.
        """

        def valid(points: Vector) -> Mask:
            asked(points)
            return self.free(points)

        def explain(point: Vector) -> tuple[Contact, ...]:
            contacts = tuple(
                Contact("point", f"wall {number}", 0.01)
                for number, wall in enumerate(self.walls)
                if bool(_inside(point[None], wall, np.zeros(self.dof))[0])
            )
            explained(contacts)
            return contacts

        def uncertain(start: Vector, end: Vector, steps: int) -> Mask:
            share = np.linspace(0.0, 1.0, steps + 1)[:, None]
            return ~self.free(start * (1 - share) + end * share, -MARGIN)

        return MotionProblem(
            np.array(self.start),
            tuple(map(Goal, self.goals)),
            np.array(self.low),
            np.array(self.high),
            valid,
            np.array(self.resolution),
            uncertain=uncertain if self.tells_uncertain else None,
            explain=explain,
        )

    def free(self, points: Vector, shrunk: float = 0.0) -> Mask:
        """Which points (N, dof) are in no wall, each made smaller by so many steps of the resolution on every side."""
        by = shrunk * np.array(self.resolution)
        blocked = [_inside(points, wall, by) for wall in self.walls]
        return ~np.any(blocked, axis=0) if blocked else np.ones(len(points), dtype=bool)


def _inside(points: Vector, wall: Box, shrunk: Vector) -> Mask:
    low, high = np.array(wall).T
    inside = ((points > low + shrunk) & (points < high - shrunk)).all(axis=1)
    return np.asarray(inside, dtype=bool)


_LEFT, _RIGHT, _MIDDLE = (0.2, 0.5), (0.8, 0.5), (0.5, 0.5)
_BLOCK: tuple[Box, ...] = (((0.45, 0.55), (0.2, 0.8)),)
_NARROW: tuple[Box, ...] = (((0.4, 0.6), (0.1, 0.96)),)
_GAP: tuple[Box, ...] = (((0.45, 0.55), (-1.0, 0.62)), ((0.45, 0.55), (0.74, 2.0)))
_FULL: tuple[Box, ...] = (((0.45, 0.55), (-1.0, 2.0)),)
_CUBOID: tuple[Box, ...] = (((0.35, 0.65), (-0.4, 0.4), (2.1, 2.4)),)
_NO_PATH = FailureKind.NO_PATH


def _three_joints(name: str, walls: tuple[Box, ...]) -> Case:
    ends = (0.1, -0.8, 2.05), ((0.9, 0.8, 2.45),)
    return Case(name, *ends, walls, low=(0.0, -1.0, 2.0), high=(1.0, 1.0, 2.5), resolution=(0.02, 0.05, 0.01))


def _unequal(name: str, start: Values, goal: Values, wall: Box, resolution: Values) -> Case:
    return Case(name, start, (goal,), (wall,), low=(-2.0, 0.5), high=(3.0, 1.0), resolution=resolution)


CASES = (
    Case("free", _LEFT, (_RIGHT,)),
    Case("already there", _LEFT, (_LEFT,)),
    Case("along the limits", (0.0, 0.0), ((1.0, 0.0),)),
    Case("around a block", _LEFT, (_RIGHT,), _BLOCK),
    Case("around a block that leaves no way but at the limits", _LEFT, (_RIGHT,), _NARROW),
    Case("through a gap", _LEFT, (_RIGHT,), _GAP),
    Case("many goals, the first in collision", _LEFT, (_MIDDLE, (0.8, 0.2), (0.8, 0.8)), _BLOCK),
    Case(
        "around a block in other limits",
        (-2.6, 2.5),
        ((-1.4, 2.5),),
        (((-2.1, -1.9), (1.9, 3.1)),),
        low=(-3.0, 1.5),
        high=(-1.0, 3.5),
        resolution=(0.04, 0.04),
        like="around a block",
    ),
    Case("around a block where what is certainly free is known", _LEFT, (_RIGHT,), _BLOCK, tells_uncertain=True),
    _three_joints("three joints", ()),
    _three_joints("three joints, around a block", _CUBOID),
    _unequal(
        "a thin wall across the finer joint", (-1.0, 0.6), (1.0, 0.9), ((-3.0, 0.5), (0.755, 0.775)), (0.25, 0.005)
    ),
    _unequal("a thin wall across the first joint", (-1.0, 0.6), (2.0, 0.7), ((0.52, 0.6), (0.0, 0.8)), (0.02, 0.1)),
    Case("start in collision", _MIDDLE, (_RIGHT,), _BLOCK, FailureKind.START_IN_COLLISION, "wall 0"),
    Case("all goals in collision", _LEFT, (_MIDDLE, (0.5, 0.3)), _BLOCK, FailureKind.GOAL_IN_COLLISION, "wall 0"),
    Case("enclosed", _LEFT, (_RIGHT,), _FULL, _NO_PATH),
    Case("enclosed, with three goals", _LEFT, (_RIGHT, (0.8, 0.2), (0.8, 0.8)), _FULL, _NO_PATH),
)
