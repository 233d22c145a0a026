"""Which box stands on which, as geometry has it."""

from __future__ import annotations

from collections.abc import Mapping

import numpy as np

from llm3.types import Pose
from llm3_bullet.poses import as_matrix
from llm3_bullet.scene import Size
from llm3_bullet.tabletop.stance import shadow

TOUCH = 0.002
"""A box whose lower side is this close to the upper side of another one, in metres, rests on it."""


def rests_on_table(pose: Pose, size: Size) -> bool:
    """Whether a box rests on the table."""
    return abs(_lower(pose, size)) <= TOUCH


def rests_on(pose: Pose, size: Size, below: Pose, size_below: Size) -> bool:
    """Whether some of a box rests on another one."""
    touches = abs(_lower(pose, size) - _upper(below, size_below)) <= TOUCH
    return touches and shadow(below, size_below).overlaps(shadow(pose, size))


def is_over(pose: Pose, below: Pose, size_below: Size) -> bool:
    """Whether the centre of something is over a box, seen from above."""
    return shadow(below, size_below).contains((pose.position[0], pose.position[1]))


def boxes_on(name: str, poses: Mapping[str, Pose], sizes: Mapping[str, Size]) -> tuple[str, ...]:
    """The boxes that rest on a box, wholly or in part."""
    return tuple(
        other
        for other, pose in poses.items()
        if other != name and rests_on(pose, sizes[other], poses[name], sizes[name])
    )


def support_of(name: str, poses: Mapping[str, Pose], sizes: Mapping[str, Size]) -> str | None:
    """The box that a box rests on with its centre over it; None if there is none."""
    pose, size = poses[name], sizes[name]
    found = (
        other
        for other, below in poses.items()
        if other != name and rests_on(pose, size, below, sizes[other]) and is_over(pose, below, sizes[other])
    )
    return next(found, None)


def _half_height(pose: Pose, size: Size) -> float:
    return float(np.abs(as_matrix(pose)[2, :3]) @ size) / 2


def _lower(pose: Pose, size: Size) -> float:
    return pose.position[2] - _half_height(pose, size)


def _upper(pose: Pose, size: Size) -> float:
    return pose.position[2] + _half_height(pose, size)
