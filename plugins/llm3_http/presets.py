"""What is known of each kind of server, as data."""

from __future__ import annotations

import re
from collections.abc import Mapping
from dataclasses import dataclass
from importlib import resources
from pathlib import Path
from typing import Literal

from llm3.errors import InputError, UsageError
from llm3.jsonio import loads, read_file
from llm3_http.address import checked_address

ReplyFormat = Literal["json_schema", "json_object", "text"]
LimitField = Literal["max_tokens", "max_completion_tokens"]
VARIABLE = "LLM3_PRESETS"
"""The environment variable that names a file of one's own presets."""


@dataclass(frozen=True)
class Preset:
    """A server and its ways.

    Raises:
        ValueError: A field cannot be what it is; the sentence names it.
    """

    base_url: str
    """The address to which ``/chat/completions``, or ``/messages``, is added."""
    key_variables: tuple[str, ...] = ()
    """The environment variables that hold its key, the first that is set; the key goes to this address only."""
    needs_key: bool = False
    """Whether it answers nobody without a key. One that needs none is taken for a local server."""
    dialect: Literal["chat", "messages"] = "chat"
    """OpenAI's chat completions, or Anthropic's Messages API."""
    reply_formats: tuple[ReplyFormat, ...] = ("json_schema", "json_object", "text")
    """What to ask for, in this order; the next one where the server refuses. ``text`` asks for nothing."""
    limit_field: LimitField = "max_tokens"
    """What the server calls the limit of a reply. Where it refuses, the other name is tried."""
    max_reply_tokens: int | None = None
    """The limit of a reply where the user gives none; None: no limit is sent."""
    cuts_long_prompts: bool = False
    """Whether it cuts off in silence what does not fit into the model's context."""

    def __post_init__(self) -> None:
        try:
            object.__setattr__(self, "base_url", checked_address(self.base_url, "base_url"))
        except UsageError as error:
            raise ValueError(str(error)) from None
        for name in self.key_variables:
            if not re.fullmatch(r"[A-Z_][A-Z0-9_]*", name):  # it may be a key, so it is not shown
                raise ValueError(
                    "key_variables must be names of environment variables, of capital letters, digits and underscores, "
                    "such as LAB_API_KEY; one of them is none"
                )
        if not self.reply_formats or len(set(self.reply_formats)) < len(self.reply_formats):
            raise ValueError(f"reply_formats must name different formats, not {list(self.reply_formats)}")
        if self.max_reply_tokens is not None and self.max_reply_tokens < 1:
            raise ValueError(f"max_reply_tokens must be at least 1, not {self.max_reply_tokens}")
        if self.dialect == "messages" and self.max_reply_tokens is None:
            raise ValueError("the dialect messages requires max_reply_tokens, such as 8192")
        if self.dialect == "messages" and "json_object" in self.reply_formats:
            raise ValueError("the dialect messages has no json_object: its reply_formats are json_schema and text")


def known_presets(environment: Mapping[str, str]) -> Mapping[str, Preset]:
    """The presets that ship with llm3, and those of the user's file, which add to them or replace them.

    Raises:
        InputError: The file that `VARIABLE` names cannot be read, or does not hold presets.
    """
    shipped = resources.files("llm3_http").joinpath("presets.json").read_bytes()
    presets = loads(shipped, dict[str, Preset], "llm3_http/presets.json")
    own = environment.get(VARIABLE, "").strip()
    return presets | _read(Path(own)) if own else presets


def _read(path: Path) -> dict[str, Preset]:
    presets = read_file(path, dict[str, Preset])
    for name in presets:
        if not re.fullmatch(r"[A-Za-z0-9][A-Za-z0-9._-]*", name):
            raise InputError(f"{path}: a preset's name is made of letters, digits, '.', '_' and '-', not {name!r}")
    return presets
