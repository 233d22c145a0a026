"""The interfaces that plugins fill."""

from llm3.interfaces.backend import BackendSettings, LLMBackend, Regions, StandIn
from llm3.interfaces.domain import Domain, Option, Options
from llm3.interfaces.env import Env, Joint
from llm3.interfaces.feedback import FeedbackSynthesizer
from llm3.interfaces.planner import MotionPlanner, PlannerSettings
from llm3.interfaces.strategy import Strategy

__all__ = [
    "BackendSettings",
    "Domain",
    "Env",
    "FeedbackSynthesizer",
    "Joint",
    "LLMBackend",
    "MotionPlanner",
    "Option",
    "Options",
    "PlannerSettings",
    "Regions",
    "StandIn",
    "Strategy",
]
