"""What the backend needs to know, and where it comes from."""

from __future__ import annotations

import math
from collections.abc import Mapping
from dataclasses import dataclass, replace

from llm3.errors import UnknownName, UsageError
from llm3.interfaces import BackendSettings
from llm3_http.address import checked_address, masked, same_address
from llm3_http.presets import Preset, known_presets
from llm3_http.secret import Secret
from llm3_http.wording import cut, one_line

BASE_URL, API_KEY = "LLM3_BASE_URL", "LLM3_API_KEY"
"""The environment variables that name a server and its key."""
_POSITIVE = ("connect_timeout", "read_timeout", "max_attempts", "deadline", "first_wait", "longest_wait", "max_body")


@dataclass(frozen=True)
class HttpSettings:
    """A server, a model, and how much patience to have with them.

    Raises:
        UsageError: A value cannot be used; the sentence names it.
    """

    model: str
    """As the server calls it."""
    preset: Preset
    """The server."""
    key: Secret = Secret()  # noqa: RUF009  # immutable
    """An empty one is not sent."""
    temperature: float | None = None
    """None: send no sampling parameter at all."""
    max_reply_tokens: int | None = None
    """What the user allows the model to write in one reply."""
    connect_timeout: float = 10.0
    """Seconds until the connection must stand."""
    read_timeout: float = 300.0
    """Seconds until one request must be answered in full."""
    max_attempts: int = 5
    """Requests for one completion that may fail in a way that may pass, the first one included."""
    deadline: float = 900.0
    """Seconds that one completion may take, all requests and waits together."""
    first_wait: float = 1.0
    """Seconds before the first retry, which double from retry to retry."""
    longest_wait: float = 30.0
    """Seconds at which the doubling ends."""
    max_body: int = 4_000_000
    """Bytes; a longer answer is refused."""

    def __post_init__(self) -> None:
        if not self.model.strip():
            raise UsageError("the backend 'http' needs the name of a model: give --model NAME")
        if self.temperature is not None and not 0 <= self.temperature < math.inf:
            raise UsageError(f"--temperature must be a number of at least 0, not {self.temperature}")
        if self.max_reply_tokens is not None and self.max_reply_tokens < 1:
            raise UsageError(f"--max-reply-tokens must be at least 1, not {self.max_reply_tokens}")
        for name in _POSITIVE:
            if not 0 < getattr(self, name) < math.inf:
                raise UsageError(f"{name} must be a positive number, not {getattr(self, name)}")

    @property
    def base_url(self) -> str:
        """The address of the server's API."""
        return self.preset.base_url

    @property
    def reply_limit(self) -> int | None:
        """Tokens that a reply may have: what the user says, or else what the server must be told."""
        return self.preset.max_reply_tokens if self.max_reply_tokens is None else self.max_reply_tokens

    @property
    def key_variables(self) -> str:
        """The environment variables that this server's key may come from, for sentences."""
        return " or ".join((API_KEY, *self.preset.key_variables))

    def clean(self, text: str) -> str:
        """Text from the server, fit to be quoted: one line, short, and without the key."""
        return cut(self.key.redact(one_line(text)))


def settings_from(asked: BackendSettings, environment: Mapping[str, str]) -> HttpSettings:
    """The settings for what the user asked.

    Args:
        asked: What the command line says.
        environment: The environment variables. `LLM3_BASE_URL` and `LLM3_API_KEY` name a server and its key,
            `LLM3_PRESETS` a file of presets; a preset's own variables are used for its own address only.

    Raises:
        UsageError: Something is missing or cannot be used; the sentence names it.
        InputError: The file of presets cannot be used.
    """
    if asked.argument is not None:
        raise UsageError(
            f"the backend 'http' takes no argument, but was given {masked(asked.argument)!r}: "
            "set LLM3_BASE_URL to the server's address"
        )
    preset, model = choose(asked.model or "", environment.get(BASE_URL, "").strip(), known_presets(environment))
    variable = key_variable(preset, environment)
    return HttpSettings(
        model=model,
        preset=preset,
        key=Secret(environment.get(variable, ""), variable) if variable else Secret(),
        temperature=asked.temperature,
        max_reply_tokens=asked.max_reply_tokens,
    )


def choose(model: str, address: str, presets: Mapping[str, Preset]) -> tuple[Preset, str]:
    """The server that is meant, and the model's name as it knows it.

    Args:
        model: What the user wrote: a name, or a preset's name, a slash and a name.
        address: What the user gave as the server's address, or nothing.
        presets: The known ones, by name.

    Raises:
        UsageError: The address is none.
        UnknownName: Without an address, there is no preset of this name.
    """
    prefix, slash, rest = model.partition("/")
    named = presets.get(prefix) if slash else None
    if not address:
        if slash and not named:  # no model of OpenAI has a slash in its name, and a key must not go astray
            raise UnknownName("preset", prefix, presets, remark=f"{BASE_URL} names a server of your own.")
        return (named, rest) if named else (presets["openai"], model)
    address = checked_address(address, BASE_URL)
    if named and same_address(named.base_url, address):
        return named, rest
    if named and not named.needs_key:
        # A local server is where the user says, but its own key stays at its own address.
        return replace(named, base_url=address, key_variables=()), rest
    there = (preset for preset in presets.values() if same_address(preset.base_url, address))
    return next(there, Preset(address)), model


def key_variable(preset: Preset, environment: Mapping[str, str]) -> str:
    """The environment variable that holds the key for this server; empty if none is set."""
    return next((name for name in (API_KEY, *preset.key_variables) if environment.get(name, "").strip()), "")
