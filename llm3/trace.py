"""The feedback trace: what the model is told of its earlier attempts."""

from __future__ import annotations

from dataclasses import dataclass, replace

from llm3.types import Attempt, Feedback


@dataclass(frozen=True)
class Trace:
    """The feedback on the last `size` attempts, the paper's k.

    A reply that could not be read takes a place like any other, but never the place of the newest attempt with
    motions: a model that stumbles over the format must not forget what it knows of the world. So a trace of size 1
    holds two entries after such a reply.
    """

    size: int
    entries: tuple[Feedback, ...] = ()
    """What the model is told, oldest first."""
    newest_with_motions: Feedback | None = None

    def add(self, attempt: Attempt, feedback: Feedback | None) -> Trace:
        """The trace with one more attempt; None, from a feedback level that tells nothing, changes nothing."""
        if feedback is None or self.size == 0:
            return self
        entries = (*self.entries, feedback)
        kept = entries[-self.size :]
        if has_motions(attempt):
            return replace(self, entries=kept, newest_with_motions=feedback)
        newest = self.newest_with_motions
        if attempt.unreadable and newest in self.entries and newest not in kept:
            kept = (newest, *entries[-max(self.size - 1, 1) :])
        return replace(self, entries=kept)


def has_motions(attempt: Attempt) -> bool:
    """Whether the attempt says anything about what the robot can do: an action worked, or its motion did not."""
    return any(outcome.failure is None or outcome.failure.kind.is_motion for outcome in attempt.outcomes)
