"""What happened against the plan, in sentences."""

from __future__ import annotations

from collections.abc import Iterator

import numpy as np

from llm3.types import Slip
from llm3_bullet.poses import Array

FAR = 0.001
"""What is off by no more than this, in metres, is as planned."""
TURNED = np.radians(1.0)
"""What is off by no more than this, in radians, is as planned."""


def slip_of(frame: Array, meant: Array, sentence: str) -> Iterator[Slip]:
    """A slip, unless two frames (4, 4) are nearly the same.

    Args:
        frame: What it is.
        meant: What it should be.
        sentence: With ``{}`` where the figures come.
    """
    position, angle = difference(frame, meant)
    if position > FAR or angle > TURNED:
        figures = f"{position * 1000:.1f} mm and {np.degrees(angle):.1f} degrees"
        yield Slip(sentence.format(figures), {"position": position, "angle": angle})


def difference(one: Array, other: Array) -> tuple[float, float]:
    """How far two frames (4, 4) are apart, in metres, and how much they are turned against each other, in radians."""
    turn = one[:3, :3].T @ other[:3, :3]
    # The sine tells small angles better than the cosine.
    sine = np.linalg.norm((turn[2, 1] - turn[1, 2], turn[0, 2] - turn[2, 0], turn[1, 0] - turn[0, 1])) / 2
    angle = np.arctan2(sine, (np.trace(turn) - 1) / 2)
    return float(np.linalg.norm(one[:3, 3] - other[:3, 3])), float(angle)


def moved(before: Array, after: Array, planned_before: Array, planned_after: Array) -> tuple[Array, Array]:
    """A frame after it moved as it did, and after it moved from the same place as planned."""
    way = planned_after[:3, 3] - planned_before[:3, 3]
    turn = planned_after[:3, :3] @ planned_before[:3, :3].T
    meant = before.copy()
    meant[:3, :3] = turn @ before[:3, :3]
    meant[:3, 3] = before[:3, 3] + way
    return after, meant
