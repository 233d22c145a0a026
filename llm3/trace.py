"""The feedback trace: what the model is told of its earlier attempts."""

from __future__ import annotations

from dataclasses import dataclass, replace

from llm3.types import Feedback


@dataclass(frozen=True)
class Trace:
    """The feedback on the last `size` attempts, the paper's k.

    A reply that could not be read takes a place like any other, but never the place of the newest attempt that had
    a plan: a model that stumbles over the format must not forget what it knows of the motions.
    """

    size: int
    entries: tuple[Feedback, ...] = ()

    def add(self, feedback: Feedback | None) -> Trace:
        """The trace with one more attempt; None, from a feedback level that tells nothing, changes nothing."""
        if feedback is None or self.size == 0:
            return self
        entries = (*self.entries, feedback)
        kept = entries[-self.size :]
        if not any(e.remarks for e in kept):
            with_plan = [e for e in entries if e.remarks]
            if with_plan:
                kept = (with_plan[-1], *entries[-max(self.size - 1, 1) :])
        return replace(self, entries=kept)
