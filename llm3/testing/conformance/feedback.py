"""The check of a feedback level."""

from __future__ import annotations

from llm3.interfaces import FeedbackSynthesizer
from llm3.testing.conformance import feedback_failures, feedback_rules
from llm3.testing.conformance.complaint import Complaint, Report
from llm3.testing.conformance.inspection import Inspection
from llm3.testing.conformance.telling import Telling

INSTEAD = "there are words for every attempt, also for one without a plan, and for a failure of every kind"
RULES = (*feedback_rules.RULES, *feedback_failures.RULES)


def check_feedback(synthesizer: FeedbackSynthesizer) -> tuple[Complaint, ...]:
    """Look for faults in a feedback level, on attempts that fail in every way."""
    return examine_feedback(synthesizer).complaints


def examine_feedback(synthesizer: FeedbackSynthesizer) -> Report:
    """Like :func:`check_feedback`, with what was looked at."""
    inspection = Inspection(INSTEAD)
    inspection.apply(RULES, Telling(synthesizer))
    return inspection.report
