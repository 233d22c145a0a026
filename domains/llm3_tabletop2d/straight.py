"""Straight pieces of a motion, and goals that are offered only where all of them are free."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from llm3.types import Contact, Event, Failure, FailureKind, Goal, Segment, Vector
from llm3_tabletop2d.bodies import Body, Separation
from llm3_tabletop2d.ways import CLEARANCE, EXACT, MARGIN, touched

STEP = 0.001
"""How far apart the samples of a straight piece are, in metres."""
End = tuple[Vector, Sequence[Body], Sequence[Body]]
"""Where a planned path ends or begins: the robot's centre, what moves there, and what stands."""


@dataclass(frozen=True)
class Leg:
    """A straight piece: the robot's centre moves from one point to another, with what moves along."""

    label: str
    begin: Vector
    end: Vector
    moving: Sequence[Body]
    standing: Sequence[Body]
    event: Event | None = None
    """What happens before it."""
    carrying: str = "held"
    """What the thing that moves along is called: held, or pushed."""

    @property
    def length(self) -> float:
        """In metres."""
        return float(np.linalg.norm(self.end - self.begin))

    @property
    def points(self) -> Vector:
        """Samples from end to end, (N, 2)."""
        steps = max(1, int(np.ceil(self.length / STEP)))
        return np.linspace(self.begin, self.end, steps + 1)


def blocked(leg: Leg) -> tuple[tuple[Contact, ...], float]:
    """What is in the way of a straight piece, and after what length in metres; no contacts where it is free."""
    separation, points = Separation(leg.moving, leg.standing), leg.points
    hit = (separation.gaps(points, MARGIN) < MARGIN - EXACT).any(axis=1)
    if not hit.any():
        return (), leg.length
    first = int(hit.argmax())
    return touched(separation, points[first : first + 1], MARGIN, leg.carrying), first / (len(points) - 1) * leg.length


def offered(legs: Sequence[Leg], ends: Sequence[End], low: Vector, high: Vector) -> Goal | Failure:
    """A goal, if all of its straight pieces are free.

    Args:
        legs: What follows once the goal is reached.
        ends: Where planned paths end before the pieces and begin after them, with the distance that those keep.
        low: The smallest x and y of the robot's centre.
        high: The largest.
    """
    for point in (p for leg in legs for p in (leg.begin, leg.end)):
        if (point < low - EXACT).any() or (point > high + EXACT).any():
            detail = f"The robot would have to stand outside of the room, at ({point[0]:.3f}, {point[1]:.3f})."
            return Failure(FailureKind.UNREACHABLE, detail, configuration=_tuple(point))
    for point, moving, standing in ends:
        contacts = touched(Separation(moving, standing), point[None], CLEARANCE)
        if contacts:
            return _in_collision(contacts, point)
    for leg in legs:
        contacts, length = blocked(leg)
        if contacts:
            detail = f"The push is stopped after {length:.3f} m." if leg.label == "push" else ""
            return _in_collision(contacts, leg.begin, detail)
    segments = (
        Segment(leg.label, (_tuple(leg.begin), _tuple(leg.end)), (leg.event,) if leg.event else ()) for leg in legs
    )
    return Goal(_tuple(legs[0].begin), tuple(segments))


def _in_collision(contacts: tuple[Contact, ...], point: Vector, detail: str = "") -> Failure:
    objects = tuple(dict.fromkeys(contact.object for contact in contacts))
    return Failure(FailureKind.GOAL_IN_COLLISION, detail, objects, contacts, _tuple(point))


def _tuple(point: Vector) -> tuple[float, ...]:
    return tuple(float(v) for v in point)
