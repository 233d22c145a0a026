"""The interfaces that plugins fill."""

from llm3.interfaces.backend import BackendSettings, LLMBackend, Regions, StandIn
from llm3.interfaces.domain import Domain, Option, Options
from llm3.interfaces.env import Env, Joint
from llm3.interfaces.executor import Executor
from llm3.interfaces.feedback import FeedbackSynthesizer
from llm3.interfaces.free_space import FreeSpace
from llm3.interfaces.model_source import ModelSource
from llm3.interfaces.planner import MotionPlanner, PlannerSettings
from llm3.interfaces.sampling import Ranges, drawn, sampling_ranges
from llm3.interfaces.scenery import Frame, Scenery
from llm3.interfaces.stage import Picture, Stage
from llm3.interfaces.strategy import Strategy
from llm3.interfaces.timing import TrajectoryTimer
from llm3.interfaces.verifier import PlanVerifier

__all__ = [
    "BackendSettings",
    "Domain",
    "Env",
    "Executor",
    "FeedbackSynthesizer",
    "Frame",
    "FreeSpace",
    "Joint",
    "LLMBackend",
    "ModelSource",
    "MotionPlanner",
    "Option",
    "Options",
    "Picture",
    "PlanVerifier",
    "PlannerSettings",
    "Ranges",
    "Regions",
    "Scenery",
    "Stage",
    "StandIn",
    "Strategy",
    "TrajectoryTimer",
    "drawn",
    "sampling_ranges",
]
