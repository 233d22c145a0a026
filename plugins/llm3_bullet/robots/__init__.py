"""Robots that are described already."""

from llm3_bullet.robots.panda import panda

__all__ = ["panda"]
