"""What a run has spent so far, whatever ends it."""

from __future__ import annotations

from llm3.types import AttemptEnded, CallFailed, ReplyReceived, RunEnded, RunEvent, Stats


class Tally:
    """An observer that knows at every moment what was spent: a run that is cut off has cost something all the same."""

    def __init__(self) -> None:
        """Nothing was spent yet."""
        self.stats = Stats()
        self.model = ""
        """The model as its server names it."""

    def __call__(self, event: RunEvent) -> None:
        """Note one event."""
        if isinstance(event, ReplyReceived):
            self.stats += event.completion.stats + Stats(llm_calls=1)
            self.model = event.completion.model or self.model
        elif isinstance(event, CallFailed):
            self.stats += event.stats
        elif isinstance(event, AttemptEnded):
            self.stats = event.stats
        elif isinstance(event, RunEnded):
            self.stats = event.result.stats
