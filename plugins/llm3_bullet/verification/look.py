"""What is seen of a world in one configuration of the robot."""

from __future__ import annotations

from dataclasses import dataclass

from llm3_bullet.poses import Array

HORIZON = 0.05
"""Metres: how far apart two things are is known up to here."""
Body = tuple[int, int]
"""PyBullet's numbers of a body and of its link."""


@dataclass(frozen=True)
class Pair:
    """Two bodies that must not touch."""

    first: Body
    second: Body
    names: tuple[str, str]
    """What they are called; the first one belongs to the robot, or is in its hand."""

    @property
    def is_within_robot(self) -> bool:
        """Whether both are links of the robot."""
        return self.first[0] == self.second[0]


@dataclass(frozen=True, eq=False)
class Look:
    """What was seen in one configuration."""

    pairs: tuple[Pair, ...]
    """What was compared with what."""
    gaps: Array
    """The distance of each pair, negative where the two touch, and `HORIZON` where it is no less, (pairs,)."""
    corners: Array
    """World positions of the corners of a box around each moving body, (bodies, 8, 3)."""

    @property
    def clearance(self) -> float:
        """How far the robot, with what it holds, is from anything but itself, in metres; at most `HORIZON`."""
        gaps = (gap for pair, gap in zip(self.pairs, self.gaps.tolist(), strict=True) if not pair.is_within_robot)
        return min(gaps, default=HORIZON)
