"""A classical baseline without a model: search over actions, sample their parameters, go back where nothing works."""

from llm3.search.limits import Limits
from llm3.search.search import ATTEMPTS, MOTION_CALLS, search

__all__ = ["ATTEMPTS", "MOTION_CALLS", "Limits", "search"]
