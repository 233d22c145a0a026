"""The conformance kit: laws that every plugin of a kind keeps, and sentences on where one does not.

A rule is a function whose name and docstring are its law, and which tells where it is broken; they stand in files by
what they look at. An `Inspection` applies them, so that a plugin that raises something ends one rule and not the check.
"""

from llm3.testing.conformance.backend import check_backend
from llm3.testing.conformance.complaint import Complaint, Report
from llm3.testing.conformance.domain import check_domain
from llm3.testing.conformance.feedback import check_feedback
from llm3.testing.conformance.planner import check_planner
from llm3.testing.conformance.strategy import check_strategy
from llm3.testing.conformance.timer import check_timer

__all__ = [
    "Complaint",
    "Report",
    "check_backend",
    "check_domain",
    "check_feedback",
    "check_planner",
    "check_strategy",
    "check_timer",
]
