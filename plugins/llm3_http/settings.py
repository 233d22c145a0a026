"""What the backend needs to know, and where it comes from."""

from __future__ import annotations

import math
from collections.abc import Mapping
from dataclasses import dataclass

from llm3.errors import UsageError
from llm3.interfaces import BackendSettings
from llm3_http.address import OPENAI, checked_address, is_openai, masked
from llm3_http.secret import Secret
from llm3_http.wording import cut, one_line

_POSITIVE = ("connect_timeout", "read_timeout", "max_attempts", "deadline", "first_wait", "longest_wait", "max_body")


@dataclass(frozen=True)
class HttpSettings:
    """A server, a model, and how much patience to have with them.

    Raises:
        UsageError: A value cannot be used; the sentence names it.
    """

    model: str
    base_url: str = OPENAI
    """The address to which ``/chat/completions`` is added."""
    key: Secret = Secret()  # noqa: RUF009  # immutable
    """Sent as a bearer token; an empty one is not sent."""
    temperature: float | None = None
    """None: send no sampling parameter at all."""
    connect_timeout: float = 10.0
    """Seconds until the connection must stand."""
    read_timeout: float = 300.0
    """Seconds until one request must be answered in full."""
    max_attempts: int = 5
    """Requests for one completion, the first one included."""
    deadline: float = 900.0
    """Seconds that one completion may take, all requests and waits together."""
    first_wait: float = 1.0
    """Seconds before the first retry, which double from retry to retry."""
    longest_wait: float = 30.0
    """Seconds at which the doubling ends."""
    max_body: int = 4_000_000
    """Bytes; a longer answer is refused."""

    def __post_init__(self) -> None:
        object.__setattr__(self, "base_url", checked_address(self.base_url))
        if not self.model.strip():
            raise UsageError("the backend 'http' needs the name of a model: give --model NAME")
        if self.temperature is not None and not 0 <= self.temperature < math.inf:
            raise UsageError(f"--temperature must be a number of at least 0, not {self.temperature}")
        for name in _POSITIVE:
            if not 0 < getattr(self, name) < math.inf:
                raise UsageError(f"{name} must be a positive number, not {getattr(self, name)}")

    @property
    def key_variables(self) -> str:
        """The environment variables that this server's key may come from, for sentences."""
        return "LLM3_API_KEY or OPENAI_API_KEY" if is_openai(self.base_url) else "LLM3_API_KEY"

    def clean(self, text: str) -> str:
        """Text from the server, fit to be quoted: one line, short, and without the key."""
        return cut(self.key.redact(one_line(text)))


def settings_from(asked: BackendSettings, environment: Mapping[str, str]) -> HttpSettings:
    """The settings for what the user asked.

    Args:
        asked: What the command line says.
        environment: The environment variables. ``LLM3_BASE_URL`` and ``LLM3_API_KEY`` name the server and its key;
            ``OPENAI_API_KEY`` is used where there is no other key, and for OpenAI's own address only.

    Raises:
        UsageError: Something is missing or cannot be used; the sentence names it.
    """
    if asked.argument is not None:
        raise UsageError(
            f"the backend 'http' takes no argument, but was given {masked(asked.argument)!r}: "
            "set LLM3_BASE_URL to the server's address"
        )
    base_url = checked_address(environment.get("LLM3_BASE_URL", "").strip() or OPENAI)
    variable = "LLM3_API_KEY"
    if is_openai(base_url) and not environment.get(variable, "").strip():
        variable = "OPENAI_API_KEY"
    return HttpSettings(
        model=asked.model or "",
        base_url=base_url,
        key=Secret(environment.get(variable, ""), variable),
        temperature=asked.temperature,
    )
