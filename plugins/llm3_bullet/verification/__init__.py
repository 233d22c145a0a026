"""A second opinion on motions: PyBullet's own kinematics and closest points, and none of the planner's code."""

from llm3_bullet.verification.playback import Playback
from llm3_bullet.verification.world import PlainWorld

__all__ = ["PlainWorld", "Playback"]
