"""Test doubles and checks for whoever writes a plugin."""

from llm3.testing.scripted import ScriptedLLM

__all__ = ["ScriptedLLM"]
