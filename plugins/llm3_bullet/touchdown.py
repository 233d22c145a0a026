"""Coming straight down on a spot, doing something there, and going straight up again.

Grasping from above and putting down are both such a touchdown.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from llm3.types import Event
from llm3_bullet.scene import Scene

Array = NDArray[np.float64]

CUT_SHORT = "The arm can reach the spot, but it cannot come straight down on it and go straight up again."
"""The detail of a failure `UNREACHABLE` where a joint limit, or a turn of the arm, interrupts the straight piece."""


@dataclass(frozen=True, eq=False)
class Touchdown:
    """One way to do it."""

    tool: Array
    """Pose of the tool frame at the bottom, (4, 4), in the world frame."""
    down: Scene
    """What the robot must not touch on the way down, and what it holds then."""
    up: Scene
    """The same for the way up."""
    after: Scene
    """The same for the path that follows, which begins where the way up ends."""
    before: tuple[Event, ...]
    """What happens before the way down, such as opening the gripper to the width of a box."""
    bottom: tuple[Event, ...]
    """What happens at the bottom, such as closing the gripper and attaching a box."""


@dataclass(frozen=True)
class TouchdownSettings:
    """Lengths in metres."""

    height: float = 0.1
    """How far above the bottom the straight piece begins and ends."""
    spacing: float = 0.01
    """Distance between the waypoints of a straight piece."""
    step: float = 0.002
    """Distance between the configurations that are tested for collision on a straight piece."""
    tolerance: float = 0.0005
    """Penetration that is no collision: a box that rests on another touches it, give or take the rounding of states."""
    enough: int = 3
    """How many goals are offered to the planner at most."""
