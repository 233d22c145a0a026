"""A backend, some of whose replies are bad."""

from __future__ import annotations

from llm3.interfaces import LLMBackend
from llm3.testing.faults import REPLY_FAULTS
from llm3.testing.schedule import Faults
from llm3.testing.wrapped import WrappedLLM
from llm3.types import Completion, Request


class Spoiler:
    """Makes bad replies of good ones, and remembers the last, which a model may repeat."""

    def __init__(self, faults: Faults) -> None:
        """Take the generator of the faults."""
        self._rng = faults.rng
        self._before: Completion | None = None

    def __call__(self, good: Completion, fault: str | None) -> Completion:
        """The reply with the fault of this name, or as it is for None."""
        reply = good if fault is None else REPLY_FAULTS[fault](good, self._before or good, self._rng)
        self._before = reply
        return reply


class FaultyLLM(WrappedLLM):
    """Asks another backend, and spoils some of its replies."""

    def __init__(self, backend: LLMBackend, faults: Faults) -> None:
        """Wrap a backend.

        Args:
            backend: Writes the good replies. It is asked for one also where the fault needs none.
            faults: Which replies go wrong, and how; any of `REPLY_FAULTS`.

        Raises:
            UnknownName: One of the faults is not a reply's.
        """
        super().__init__(backend)
        faults.check(REPLY_FAULTS)
        self.injected: list[str | None] = []
        """The fault of each reply so far, None for a good one."""
        self._choose, self._spoil = faults.choose, Spoiler(faults)

    def complete(self, request: Request) -> Completion:
        """The other one's reply, or a bad one in its place; raises what the other one raises."""
        good = self._backend.complete(request)
        self.injected.append(self._choose(len(self.injected) + 1))
        return self._spoil(good, self.injected[-1])
