"""Whether the motion of an action did what the action says."""

from __future__ import annotations

import numpy as np

from llm3_bullet.verification.boxes import Frame, matrix
from llm3_bullet.verification.playback import Playback

OFF_PLACE = 0.002
"""How far from the place that an action names a box may be let go, in metres."""
OFF_ANGLE = 0.01
"""How far a box may be turned from the angle that an action names, in radians."""


def check_pick(playback: Playback, name: str) -> None:
    """See that the last action took a box, and nothing else happened."""
    if playback.world.held != name:
        playback.findings.tell(f"the gripper does not hold {name} after it")
    elif playback.let_go:
        let_go = ", ".join(playback.let_go)
        playback.findings.tell(f"the gripper lets go of {let_go}, and only takes something in a pick")


def check_place(playback: Playback, name: str, x: float, y: float, theta: float | None = None) -> None:
    """See that the last action let a box go with its centre at (x, y), and turned by theta if that is given."""
    if not check_let_go(playback, name):
        return
    frame, tell = playback.let_go[name], playback.findings.tell
    if np.hypot(frame[0][0] - x, frame[0][1] - y) > OFF_PLACE:
        tell(f"{name} is let go at ({frame[0][0]:.4f}, {frame[0][1]:.4f}), not at ({x:.4f}, {y:.4f})")
    turned = _angle(frame)
    if theta is not None and abs(np.angle(np.exp(1j * (turned - theta)))) > OFF_ANGLE:
        tell(f"{name} is let go at an angle of {turned:.3f} rad, not {theta:.3f} rad")


def check_let_go(playback: Playback, name: str) -> bool:
    """See that the last action let a box go, and nothing else; whether it did."""
    if list(playback.let_go) == [name]:
        return True
    playback.findings.tell(f"the gripper does not let go of {name}")
    return False


def _angle(frame: Frame) -> float:
    """The direction, seen from above, of the first axis of a box that is not its vertical one."""
    axes = matrix(frame[1])
    vertical = int(np.abs(axes[2]).argmax())
    first = 1 if vertical == 0 else 0
    return float(np.arctan2(axes[1, first], axes[0, first]))
