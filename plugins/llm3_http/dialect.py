"""How a server is spoken to."""

from __future__ import annotations

from abc import ABC, abstractmethod
from collections.abc import Mapping
from typing import Any

from llm3.types import Completion, Request
from llm3_http.features import Features
from llm3_http.settings import HttpSettings


class Dialect(ABC):
    """The form of a request and of its answer."""

    path: str
    """What is added to the base address."""
    key_header: str
    """The header that holds the key."""
    key_prefix: str
    """What stands before the key there."""
    headers: Mapping[str, str]
    """What else the headers of every request hold."""

    @abstractmethod
    def payload(self, settings: HttpSettings, features: Features, request: Request) -> dict[str, Any]:
        """The JSON of a request."""

    @abstractmethod
    def completion(self, document: Mapping[str, Any], settings: HttpSettings) -> Completion | None:
        """The answer in the JSON object of a successful reply; None if there is none in it."""
