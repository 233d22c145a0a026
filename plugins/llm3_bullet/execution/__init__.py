"""A robot with motors among boxes with mass: what becomes of a plan where nothing is put anywhere by decree."""

from llm3_bullet.execution.course import check_events, course
from llm3_bullet.execution.hand import Hand
from llm3_bullet.execution.hands import hand_of
from llm3_bullet.execution.performance import Performance
from llm3_bullet.execution.scatter import scatter
from llm3_bullet.execution.settings import ExecutionSettings
from llm3_bullet.execution.world import MotorWorld

__all__ = ["ExecutionSettings", "Hand", "MotorWorld", "Performance", "check_events", "course", "hand_of", "scatter"]
