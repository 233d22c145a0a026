"""A backend whose requests somebody else sees."""

from __future__ import annotations

from collections.abc import Callable

from llm3.interfaces import LLMBackend
from llm3.testing.wrapped import WrappedLLM
from llm3.types import Completion, Request


class Tapped(WrappedLLM):
    """Tells of each request before it passes it on."""

    def __init__(self, backend: LLMBackend, learn: Callable[[Request], None]) -> None:
        """Wrap a backend."""
        super().__init__(backend)
        self._learn = learn

    def complete(self, request: Request) -> Completion:
        """The other one's answer."""
        self._learn(request)
        return self._backend.complete(request)

    def examine(self) -> str:
        """What the other one finds."""
        return self._backend.examine()
