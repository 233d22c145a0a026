"""A backend whose requests somebody else sees."""

from __future__ import annotations

from collections.abc import Callable

from llm3.interfaces import LLMBackend
from llm3.types import Completion, Request


class Tapped(LLMBackend):
    """Tells of each request before it passes it on."""

    def __init__(self, backend: LLMBackend, learn: Callable[[Request], None]) -> None:
        """Wrap a backend."""
        self._backend, self._learn = backend, learn

    @property
    def is_language_model(self) -> bool:
        """Whether the other one is a language model."""
        return self._backend.is_language_model

    @property
    def notice(self) -> str:
        """What the other one says."""
        return self._backend.notice

    @property
    def last_words(self) -> str:
        """What the other one says."""
        return self._backend.last_words

    def complete(self, request: Request) -> Completion:
        """The other one's answer."""
        self._learn(request)
        return self._backend.complete(request)

    def examine(self) -> str:
        """What the other one finds."""
        return self._backend.examine()

    def close(self) -> None:
        """Close the other one."""
        self._backend.close()
