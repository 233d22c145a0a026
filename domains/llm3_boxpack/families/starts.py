"""Where boxes start on the table: spread out, or so close together that the order of picking matters."""

from __future__ import annotations

from collections.abc import Iterator, Sequence

import numpy as np

from llm3_boxpack.families.hand import Hand
from llm3_boxpack.families.spots import FARTHEST, NEAREST, flush
from llm3_boxpack.families.standing import Standing

BEHIND = 1.5
"""How far to the side of the arm boxes start at most, in radians from straight ahead."""
DRAWS = 300
"""How many spots are drawn for a box at once."""
CHOICE = 6
"""Among how many of the most obstructive spots one is drawn."""


def spread(
    boxes: Sequence[Standing],
    obstacles: Sequence[Standing],
    hand: Hand,
    rng: np.random.Generator,
    keep_free: Sequence[Standing] = (),
) -> tuple[Standing, ...] | None:
    """Spots on the table from which each box can be taken while all others are there; None where there are none.

    Args:
        boxes: Wherever they stand; each is turned by a quarter at random.
        obstacles: What else can be in the way.
        hand: What takes them.
        rng: Draws the spots.
        keep_free: What must not be harder to take than before; it is there, too.
    """
    done: list[Standing] = []
    for box in boxes:
        spot = next(_leaving_room(box, (*done, *keep_free), obstacles, hand, rng), None)
        if spot is None:
            return None
        done.append(spot)
    return tuple(done)


def _leaving_room(
    box: Standing, others: Sequence[Standing], obstacles: Sequence[Standing], hand: Hand, rng: np.random.Generator
) -> Iterator[Standing]:
    """Where the box can be taken, and is in nobody's way."""
    turned = (box.turned() if rng.random() < 0.5 else box).raised(0.0)
    radius, angle = rng.uniform(NEAREST, FARTHEST, DRAWS), rng.uniform(-BEHIND, BEHIND, DRAWS)
    centers = (radius * (np.cos(angle), np.sin(angle))).T.round()
    for x, y in centers[hand.free(turned, centers, (*obstacles, *others))].tolist():
        spot = turned.at(x, y)
        if all(hand.is_free(other, (spot,)) for other in others):
            yield spot


def crowded(
    boxes: Sequence[Standing],
    obstacles: Sequence[Standing],
    low: tuple[float, float],
    high: tuple[float, float],
    hand: Hand,
    rng: np.random.Generator,
) -> tuple[Standing, ...] | None:
    """Spots close together from which the boxes can be taken in this order; None where there are none.

    The last one is put down first, and each further one where it is most in the way of those that are there.

    Args:
        boxes: Wherever they stand, in the order in which they are to be taken.
        obstacles: What else can be in the way.
        low: The corner of the area in which they start,
        high: and the opposite one.
        hand: What takes them.
        rng: Draws the spots.
    """
    done: list[Standing] = []
    for box in reversed(boxes):
        spots = flush(box.raised(0.0), (*obstacles, *done), low, high, hand)
        if not spots:
            return None
        middle = np.mean([(d.x, d.y) for d in done], axis=0) if done else (np.array(low) + high) / 2
        hindrance = [_hindrance(spot, done, hand) for spot in spots]
        most = max(hindrance)
        worst = [spot for spot, count in zip(spots, hindrance, strict=True) if count == most]
        worst.sort(key=lambda spot: abs(spot.x - middle[0]) + abs(spot.y - middle[1]))
        done.append(worst[int(rng.integers(min(CHOICE, len(worst))))])
    return tuple(reversed(done))


def _hindrance(spot: Standing, done: Sequence[Standing], hand: Hand) -> int:
    """How many of the boxes cannot be taken because of this one."""
    return sum(bool(hand.in_the_way(other, (spot,))) for other in done)


def beside(
    things: Sequence[Standing],
    boxes: Sequence[Standing],
    obstacles: Sequence[Standing],
    hand: Hand,
    rng: np.random.Generator,
) -> tuple[Standing, ...] | None:
    """Spots for things from which they can be taken, each so close to a box of its own that this one cannot."""
    done: list[Standing] = []
    for thing, index in zip(things, rng.permutation(len(boxes)).tolist(), strict=False):
        box = boxes[index]
        spots = flush(thing.raised(0.0), (box,), (-FARTHEST, -FARTHEST), (FARTHEST, FARTHEST), hand)
        good = [
            spot for spot in spots if hand.in_the_way(box, (spot,)) and hand.is_free(spot, (*obstacles, *boxes, *done))
        ]
        if not good:
            return None
        done.append(good[int(rng.integers(len(good)))])
    return tuple(done)
