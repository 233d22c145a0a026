"""Task and motion planning with a language model that reasons about motion failures."""

from llm3.assembly import RunConfig, assemble, prepare
from llm3.budget import Budget
from llm3.errors import LLM3Error
from llm3.hookspecs import hookimpl
from llm3.interfaces import (
    BackendSettings,
    Domain,
    Env,
    FeedbackSynthesizer,
    Joint,
    LLMBackend,
    MotionPlanner,
    Option,
    PlannerSettings,
    Strategy,
    TrajectoryTimer,
)
from llm3.prompts import Prompt
from llm3.registry import Registry
from llm3.search import search
from llm3.solve import solve

__all__ = [
    "BackendSettings",
    "Budget",
    "Domain",
    "Env",
    "FeedbackSynthesizer",
    "Joint",
    "LLM3Error",
    "LLMBackend",
    "MotionPlanner",
    "Option",
    "PlannerSettings",
    "Prompt",
    "Registry",
    "RunConfig",
    "Strategy",
    "TrajectoryTimer",
    "assemble",
    "hookimpl",
    "prepare",
    "search",
    "solve",
]
