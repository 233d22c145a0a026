"""Which boxes are in one another."""

from __future__ import annotations

from collections.abc import Sequence
from math import dist, hypot

import numpy as np

from llm3_bullet.poses import as_matrix
from llm3_bullet.scene import Box

RESTING = 0.0005
"""Boxes are in one another by more than this, in metres: what rests on another one touches it, give or take the
rounding of states."""


def depth(first: Box, second: Box) -> float:
    """How far two boxes are in one another: the shortest way, in metres, by which one would have to be moved to be out.

    Negative where they are apart (separating axis theorem).
    """
    ours, theirs = as_matrix(first.pose), as_matrix(second.pose)
    own, other = ours[:3, :3].T, theirs[:3, :3].T  # a box's axes as rows
    crossed = np.cross(own[:, None], other).reshape(-1, 3)
    lengths = np.linalg.norm(crossed, axis=1)
    skew = lengths > 1e-6  # parallel sides have no direction across both
    axes = np.vstack([own, other, crossed[skew] / lengths[skew, None]])
    reach = np.abs(axes @ own.T) @ first.size + np.abs(axes @ other.T) @ second.size
    return float((reach / 2 - np.abs(axes @ (theirs[:3, 3] - ours[:3, 3]))).min())


def overlap(boxes: Sequence[Box], furniture: Sequence[Box]) -> tuple[str, str] | None:
    """The names of a box and of something that it is in; None where there is no such pair.

    Args:
        boxes: Each is compared with those before it,
        furniture: and with all of these.
    """
    for index, box in enumerate(boxes):
        for other in (*furniture, *boxes[:index]):
            near = dist(box.pose.position, other.pose.position) < (hypot(*box.size) + hypot(*other.size)) / 2
            if near and depth(box, other) > RESTING:
                return other.name, box.name
    return None
