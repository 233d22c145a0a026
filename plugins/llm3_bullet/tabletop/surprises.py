"""What physics did to the boxes after one was taken or let go: whether it counts, and in words."""

from __future__ import annotations

from collections.abc import Mapping

import numpy as np

from llm3.types import Pose
from llm3_bullet.poses import as_matrix
from llm3_bullet.scene import Size

STILL = 0.0005
"""A box of which no corner moved by more than this, in metres, has not moved: simulated rest is no more exact."""
SLID = 0.005
"""A box that moved sideways by more than this, in metres, has slid."""
TURNED = 0.05
"""A box that turned about the vertical by more than this, in radians, has turned."""
LEANS = np.radians(5.0)
"""A box that tilted by more than this, in radians, leans: it can no longer be taken from above."""
TOPPLED = np.radians(45.0)
"""A box that tilted by more than this, in radians, has toppled."""


def surprises(before: Mapping[str, Pose], after: Mapping[str, Pose]) -> tuple[str, ...]:
    """One sentence for each box that did not stay where it was, or where it was put."""
    return tuple(note for name in after if (note := _surprise(name, before[name], after[name])))


def is_still(before: Pose, after: Pose, size: Size) -> bool:
    """Whether a box has not moved."""
    change = as_matrix(after) - as_matrix(before)
    farthest = np.linalg.norm(change[:3, 3]) + np.linalg.norm(change[:3, :3]) * np.linalg.norm(size) / 2
    return bool(farthest <= STILL)


def _surprise(name: str, before: Pose, after: Pose) -> str:
    old, new = as_matrix(before), as_matrix(after)
    turn = new[:3, :3] @ old[:3, :3].T
    place = f"and is at ({after.position[0]:.3f}, {after.position[1]:.3f}) now"
    tilt = float(np.arccos(np.clip(turn[2, 2], -1.0, 1.0)))
    if tilt > TOPPLED:
        return f"{name} toppled {place}"
    if tilt > LEANS:
        return f"{name} leans by {np.degrees(tilt):.0f} degrees {place}"
    slid = float(np.linalg.norm(new[:2, 3] - old[:2, 3]))
    angle = float(np.arctan2(turn[1, 0], turn[0, 0]))
    if slid > SLID:
        return f"{name} slid by {slid * 1000:.0f} mm {place}"
    if abs(angle) > TURNED:
        return f"{name} turned by {angle:.2f} rad {place}"
    return ""
