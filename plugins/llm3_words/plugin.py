"""Registers the feedback levels ``categorized``, ``binary`` and ``none``."""

from __future__ import annotations

from collections.abc import Callable, Mapping

from llm3.hookspecs import hookimpl
from llm3.interfaces import FeedbackSynthesizer
from llm3_words.synthesizers import Binary, Categorized, Silent


@hookimpl
def llm3_feedback() -> Mapping[str, Callable[[], FeedbackSynthesizer]]:
    """The paper's feedback, and the two levels that tell less."""
    return {"categorized": Categorized, "binary": Binary, "none": Silent}
