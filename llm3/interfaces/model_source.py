"""Where language models can be had."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Literal


@dataclass(frozen=True)
class ModelSource:
    """What a user can write before the slash of ``--model NAME/MODEL``."""

    name: str
    address: str
    """Where it is asked."""
    key: Literal["set", "not set", "not needed"]
    """Whether there is a key for it; never the key itself."""
    key_variables: tuple[str, ...] = ()
    """The environment variable that holds the key, or else those where one is looked for."""
