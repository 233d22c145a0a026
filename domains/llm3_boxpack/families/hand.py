"""The space that a hand with two fingers takes around a box: with it a spot is one for the gripper, too.

Lengths in millimetres. The hand comes straight down and goes straight up again, so it takes a space above a height:
between the fingers' tips and the palm that of two fingers, and from the palm on all that is below the flange.

What is around the hand proves that there is room for it, and what is inside of it that there is none.
"""

from __future__ import annotations

from collections.abc import Callable, Iterable
from dataclasses import dataclass
from math import ceil, inf

import numpy as np
from numpy.typing import NDArray

from llm3_boxpack.families.standing import Standing, table_of
from llm3_bullet.robot import Gripper, SuctionGripper
from llm3_bullet.tabletop.grasps import OPENING_MARGIN, hand_heights, widest

GAP = 3.0
"""Between two boxes, and between a box and a wall."""
MARGIN = 2.0
"""More than the hand's own size: PyBullet's meshes are 1 mm thicker than drawn, and no hand is quite symmetrical."""

FINGER_CORE = ((4.0, 14.0, 12.0), (22.0, 20.0, 16.0))
"""Blocks inside of a Panda's finger: how far above its tip they begin, how far they reach from its inner face, and how
wide they are."""
PALM_CORE = (4.0, 186.0, 30.0)
"""A block inside of a Panda's palm: how far above its lower face it begins, and its size along the line from finger to
finger, and across."""

Mask = NDArray[np.bool_]


@dataclass(frozen=True)
class Space:
    """A block of space above a height, beside the centre of a box."""

    x: float
    y: float
    dx: float
    dy: float
    low: float
    """Above the table."""


@dataclass(frozen=True)
class Hand:
    """What a gripper needs beside a box to take it, or to let go of it."""

    finger_reach: float
    """How far a finger stands out beyond the box then."""
    finger_width: float
    palm_size: tuple[float, float]
    """Along the line from finger to finger, and across."""
    heights: Callable[[float], tuple[float, float]]
    """How high the fingers' tips and the palm are above what a box of some height stands on."""
    widest: float = inf
    """What fits between the fingers."""
    opening: float = 1000 * OPENING_MARGIN / 2
    """How far a finger's inner face is from the box when it is open around it."""

    @staticmethod
    def of(gripper: Gripper) -> Hand:
        """That of a gripper.

        Raises:
            ValueError: Not all of its sizes are known.
        """
        if isinstance(gripper, SuctionGripper) or gripper.finger_width is None or gripper.palm_size is None:
            raise ValueError("there must be fingers, and their width and the size of the palm must be known")

        def heights(height: float) -> tuple[float, float]:
            tips, palm = hand_heights(height / 1000, gripper)
            return 1000 * tips, 1000 * palm

        along, across = gripper.palm_size
        return Hand(
            1000 * (gripper.finger_reach + OPENING_MARGIN / 2),
            1000 * gripper.finger_width,
            (1000 * along, 1000 * across),
            heights,
            1000 * widest(gripper),
        )

    @property
    def room(self) -> float:
        """What a finger needs beside a box, in whole millimetres."""
        return float(ceil(self.finger_reach + MARGIN))

    def around(self, box: Standing) -> tuple[Space, ...]:
        """Blocks around fingers and palm; the fingers are at the two long sides of a box, which are closer together."""
        along, across = (length + 2 * MARGIN for length in self.palm_size)
        width, reach = self.finger_width + 2 * MARGIN, self.finger_reach + MARGIN
        tips, palm = (box.bottom + height - MARGIN for height in self.heights(box.height))
        return (*_beside(box, 0.0, reach, width, tips), _across(box, 0.0, along, across, palm))

    def inside(self, box: Standing) -> tuple[Space, ...]:
        """Blocks inside of fingers and palm, if they are the Panda's."""
        tips, palm = (box.bottom + height for height in self.heights(box.height))
        above, along, across = PALM_CORE
        fingers = [
            space
            for higher, reach, width in FINGER_CORE
            for space in _beside(box, self.opening, self.opening + reach, width, tips + higher)
        ]
        return (*fingers, _across(box, 0.0, along, across, palm + above))

    def in_the_way(self, box: Standing, others: Iterable[Standing]) -> tuple[str, ...]:
        """What the hand would certainly touch there; what the box itself would touch does not count."""
        rows = tuple(others)
        (touched,) = _touched(self.inside(box), np.array([[box.x, box.y]]), rows)
        return tuple(thing.name for thing, is_touched in zip(rows, touched, strict=True) if is_touched)

    def free(self, box: Standing, centers: NDArray[np.float64], others: Iterable[Standing]) -> Mask:
        """At which of the centres (K, 2) there is room for the box and the hand."""
        body = Space(0.0, 0.0, box.dx + 2 * GAP, box.dy + 2 * GAP, box.bottom)
        return np.asarray(~_touched((body, *self.around(box)), centers, others).any(axis=1))

    def is_free(self, box: Standing, others: Iterable[Standing]) -> bool:
        """Whether there is room for box and hand where the box stands."""
        return bool(self.free(box, np.array([[box.x, box.y]]), others)[0])


def _beside(box: Standing, near: float, far: float, width: float, low: float) -> tuple[Space, Space]:
    """Blocks on both sides of a box, from one distance from its face to another."""
    middle = (min(box.dx, box.dy) + near + far) / 2
    return _across(box, -middle, far - near, width, low), _across(box, middle, far - near, width, low)


def _across(box: Standing, offset: float, along: float, across: float, low: float) -> Space:
    """A block that lies across the long sides of a box, off its middle by some way."""
    return Space(offset, 0.0, along, across, low) if box.is_along_y else Space(0.0, offset, across, along, low)


def _touched(spaces: Iterable[Space], centers: NDArray[np.float64], others: Iterable[Standing]) -> Mask:
    """(K, N): whether any of the spaces around each centre meets each of the others."""
    x, y, dx, dy, top = table_of(others).T
    touched = np.zeros((len(centers), len(top)), dtype=bool)
    for space in spaces:
        beside_x = np.abs(centers[:, :1] + space.x - x) < (space.dx + dx) / 2
        beside_y = np.abs(centers[:, 1:] + space.y - y) < (space.dy + dy) / 2
        touched |= beside_x & beside_y & (top > space.low)
    return touched
