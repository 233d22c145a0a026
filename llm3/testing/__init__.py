"""Test doubles and checks for whoever writes a plugin."""

from llm3.testing.conformance import (
    Complaint,
    check_backend,
    check_domain,
    check_feedback,
    check_planner,
    check_strategy,
    check_timer,
)
from llm3.testing.faults import REPLY_FAULTS
from llm3.testing.faulty import FaultyLLM
from llm3.testing.schedule import Faults
from llm3.testing.scripted import ScriptedLLM, stand_in_script
from llm3.testing.server import LLMServer
from llm3.testing.wire import WIRE_FAULTS

__all__ = [
    "REPLY_FAULTS",
    "WIRE_FAULTS",
    "Complaint",
    "Faults",
    "FaultyLLM",
    "LLMServer",
    "ScriptedLLM",
    "check_backend",
    "check_domain",
    "check_feedback",
    "check_planner",
    "check_strategy",
    "check_timer",
    "stand_in_script",
]
