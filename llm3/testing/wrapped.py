"""Another backend with something in between."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

from llm3.interfaces import LLMBackend


class WrappedLLM(LLMBackend):
    """Says of itself what the backend inside says; what it answers is for those that build on it."""

    def __init__(self, backend: LLMBackend) -> None:
        """Wrap a backend."""
        self._backend = backend

    @property
    def is_language_model(self) -> bool:
        """Whether the backend inside is one."""
        return self._backend.is_language_model

    @property
    def notice(self) -> str:
        """What the backend inside says."""
        return self._backend.notice

    @property
    def recorded(self) -> Mapping[str, Any]:
        """What the backend inside says."""
        return self._backend.recorded

    @property
    def last_words(self) -> str:
        """What the backend inside says."""
        return self._backend.last_words

    def close(self) -> None:
        """Close the backend inside."""
        self._backend.close()
