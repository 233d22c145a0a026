"""A second opinion on motions: PyBullet's own kinematics and closest points, and none of the planner's code."""

from llm3_bullet.verification.deeds import check_let_go, check_pick, check_place
from llm3_bullet.verification.playback import Playback
from llm3_bullet.verification.second_look import second_look
from llm3_bullet.verification.world import PlainWorld

__all__ = ["PlainWorld", "Playback", "check_let_go", "check_pick", "check_place", "second_look"]
