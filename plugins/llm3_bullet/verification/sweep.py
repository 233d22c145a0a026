"""Looks along a piece of motion closely enough that nothing can hide between two looks."""

from __future__ import annotations

from collections.abc import Callable, Iterator
from dataclasses import dataclass

import numpy as np

from llm3_bullet.poses import Array
from llm3_bullet.verification.look import Look
from llm3_bullet.verification.world import PlainWorld

STEP = 0.0005
"""Metres: bodies that come nearer to one another by no more than this between two looks need no look in between."""
ACCURACY = 0.00075
"""Metres: by so much PyBullet may take two separate things for farther apart than they are, as it rounds the corners
of boxes off (a margin of 1 mm, times √3 - 1)."""
CONTACT = 0.001
"""Metres: what is deeper is a collision. PyBullet's hulls of links are this much larger than the links."""


@dataclass(frozen=True, eq=False)
class Piece:
    """A smooth piece of motion: configurations with the gripper's opening as last value, (dof + 1,)."""

    at: Callable[[float], Array]
    """The configuration at u, from 0 to 1."""
    bend: float
    """A bound on the second derivative by u of the path of any point of the robot, for a lever of 1 m."""


def line(a: Array, b: Array) -> Piece:
    """Straight from one configuration to another."""
    return Piece(lambda u: a + u * (b - a), float(np.abs(b - a).sum()) ** 2)


def cubic(a: Array, b: Array, velocity_a: Array, velocity_b: Array) -> Piece:
    """The cubic polynomial between two configurations that has these derivatives by u at its ends."""
    c2 = 3 * (b - a) - 2 * velocity_a - velocity_b
    c3 = 2 * (a - b) + velocity_a + velocity_b
    bend = np.maximum(np.abs(2 * c2), np.abs(2 * c2 + 6 * c3))  # the second derivative is linear in u
    speed = np.maximum(np.abs(velocity_a), np.abs(velocity_b)) + bend / 4  # it strays from linear by no more
    return Piece(lambda u: a + u * (velocity_a + u * (c2 + u * c3)), float(bend.sum() + speed.sum() ** 2))


def sweep(world: PlainWorld, piece: Piece) -> Iterator[tuple[float, Look]]:
    """What is seen along a piece, and where: at its ends first, then wherever two looks leave something open.

    Two bodies that were d1 and d2 apart at two looks cannot have touched in between if they came nearer to one another
    by less than d1 + d2 on the way (Schwarzer, Saha and Latombe, "Adaptive dynamic collision checking for single and
    multiple articulated robots in complex environments", IEEE Transactions on Robotics 21, 2005). How far a body
    travels is read from the corners of a box around it, and how far its path strays from the straight line between
    two looks is bounded by its second derivative. Where neither this nor `STEP` settles it, the middle is looked at. So
    what is missed is less than `STEP` / 2 deeper than what is seen, but for what is a collision at a look already.
    """

    def look(u: float) -> Look:
        world.move(piece.at(u))
        return world.look()

    first, last = look(0.0), look(1.0)
    yield 0.0, first
    if np.array_equal(piece.at(0.0), piece.at(1.0)) and not piece.bend:
        return
    yield 1.0, last
    open_ = [(0.0, first, 1.0, last)]
    while open_:
        u, a, v, b = open_.pop()
        if not _is_settled(world, a, b, world.lever * piece.bend * (v - u) ** 2 / 8):
            middle = (u + v) / 2
            seen = look(middle)
            yield middle, seen
            open_ += [(middle, seen, v, b), (u, a, middle, seen)]


def _is_settled(world: PlainWorld, a: Look, b: Look, stray: float) -> bool:
    """Whether nothing unseen can have happened between two looks.

    Args:
        world: Where they were made.
        a: One look.
        b: The other.
        stray: How far a point may stray from the straight line between where it was at the two, in metres.
    """
    travel = np.linalg.norm(b.corners - a.corners, axis=2).max(axis=1) + 2 * stray
    approach = world.approach(travel)
    hit = np.minimum(a.gaps, b.gaps) < -CONTACT  # no closer look at what is a collision already
    free = approach < a.gaps + b.gaps - 2 * ACCURACY
    return bool((hit | free | (approach <= STEP)).all())
