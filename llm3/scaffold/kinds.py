"""What packages there are to begin with."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from types import MappingProxyType

TRIED = "--domain tabletop2d"
"""The problem on which plugins that are no domain are tried out."""


@dataclass(frozen=True)
class Kind:
    """A package to begin with."""

    what: str
    """What it is, in a sentence."""
    registered: str
    """What the registry calls such a plugin."""
    templates: str
    """The folder of its templates."""
    description: str
    """What the new package says of itself, in a line."""
    trial: str
    """The arguments of llm3 that try it out; NAME stands for its name."""
    checked: str = "NAME"
    """What ``llm3 check`` is given."""


KINDS: Mapping[str, Kind] = MappingProxyType(
    {
        "domain": Kind(
            "a domain",
            "domain",
            "domain",
            "A point robot carries a ball around a pillar",
            "--domain NAME",
        ),
        "planner": Kind(
            "a planner",
            "planner",
            "planner",
            "A motion planner: a rapidly exploring random tree",
            f"{TRIED} --planner NAME",
        ),
        "feedback": Kind(
            "a feedback level",
            "feedback",
            "feedback",
            "Feedback that tells how far to move away",
            f"{TRIED} --feedback NAME",
        ),
        "backend": Kind(
            "a backend",
            "backend",
            "backend",
            "A model backend that asks a program",
            "doctor --llm NAME:cat",
            checked="NAME:cat",  # a program that is everywhere, and echoes what it reads
        ),
        "strategy": Kind(
            "a strategy",
            "strategy",
            "strategy",
            "A prompt strategy that asks in few words",
            f"prompt {TRIED} --strategy NAME",
        ),
    }
)
"""By what follows ``llm3 new``."""

BULLET_DOMAIN = Kind(
    "a domain",
    "domain",
    "bullet-domain",
    "A robot arm puts a box onto a mat",
    "--domain NAME",
)
"""A domain whose world is simulated by PyBullet."""
