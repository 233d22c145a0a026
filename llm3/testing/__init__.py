"""Test doubles and checks for whoever writes a plugin."""

from llm3.testing.faults import REPLY_FAULTS
from llm3.testing.faulty import FaultyLLM
from llm3.testing.schedule import Faults
from llm3.testing.scripted import ScriptedLLM, stand_in_script
from llm3.testing.server import LLMServer
from llm3.testing.wire import WIRE_FAULTS

__all__ = ["REPLY_FAULTS", "WIRE_FAULTS", "Faults", "FaultyLLM", "LLMServer", "ScriptedLLM", "stand_in_script"]
