"""The figures of a world with motors."""

from __future__ import annotations

from dataclasses import dataclass, field

from llm3_bullet.settle import SettlerSettings


@dataclass(frozen=True)
class ExecutionSettings:
    """The physics of an execution; see also `SettlerSettings`, whose boxes and time step these are."""

    boxes: SettlerSettings = field(default_factory=SettlerSettings)
    """What boxes weigh, their friction, the time step, and what counts as rest."""
    position_gain: float = 0.3
    """Which part of its error a motor tries to make good for in one time step."""
    default_effort: float = 100.0
    """The most that a motor can do, in N m (N where a joint slides), where the robot's file does not say."""
    pad_friction: float = 1.0
    """Coulomb coefficient of the fingers, as of rubber; a contact has the product of two."""
    pad_spin: float = 0.1
    """Against turning about the line between the fingers, as pads touch in an area and not in a point, in metres."""
    finger_speed: float = 0.05
    """How fast each finger moves, in m/s."""
    grip_force: float = 20.0
    """The most that each finger pushes with, in N."""
    release: float = 0.008
    """How much farther the fingers open to let go, in metres."""
    cup_reach: float = 0.003
    """A cup takes what is as near as this, in metres."""
    cup_tilt: float = 0.1
    """How far a cup may lean against the face that it takes, in radians."""
    suction: float = 60e3
    """The pump's, in Pa: times the area of the rim, the force at which a box breaks away."""
    longest_wait: float = 2.0
    """Things that do not come to rest are waited for no longer than this, in seconds."""
    still: float = 1e-3
    """A joint slower than this, in rad/s or m/s, may be at rest."""
