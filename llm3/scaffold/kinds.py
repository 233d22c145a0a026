"""What packages there are to begin with."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from types import MappingProxyType

TRIED = "--domain tabletop2d"
"""The problem on which plugins that are no domain are tried out."""
TAUGHT = f"{TRIED} --setting clutter"
"""One whose first plan fails, so that there is something to be told of it."""
WORDS = ("none", "loop", "search")
"""What stands in place of a plugin's name and is none: no plugin at all, and the solvers."""


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
    tried: str
    """What llm3 does with these arguments."""
    checked: str = "NAME"
    """What ``llm3 check`` is given."""
    used: tuple[str, ...] = ()
    """The names by which llm3 itself asks for such a plugin, where the user names none."""


KINDS: Mapping[str, Kind] = MappingProxyType(
    {
        "domain": Kind(
            "a domain",
            "domain",
            "domain",
            "A point robot carries a ball around a pillar",
            "--domain NAME",
            "solves the problem of seed 0; where no model is named, a stand-in draws the numbers",
        ),
        "planner": Kind(
            "a planner",
            "planner",
            "planner",
            "A motion planner: a rapidly exploring random tree",
            f"{TRIED} --planner NAME",
            "solves a problem that ships with llm3, without a model; this planner plans its motions",
            used=("birrt",),
        ),
        "feedback": Kind(
            "a feedback level",
            "feedback",
            "feedback",
            "Feedback that tells how far to move away",
            f"{TAUGHT} --feedback NAME",
            "solves a problem whose first plan fails, without a model; what is told of it is in the record",
            used=("categorized",),
        ),
        "backend": Kind(
            "a backend",
            "backend",
            "backend",
            "A model backend that asks a program",
            "doctor --llm NAME:cat",
            "asks the program `cat` one tiny question, and tells what came back",
            checked="NAME:cat",  # a program that is everywhere, and echoes what it reads
            used=("http", "offline", "random", "replay"),
        ),
        "strategy": Kind(
            "a strategy",
            "strategy",
            "strategy",
            "A prompt strategy that asks in few words",
            f"prompt {TRIED} --strategy NAME",
            "prints what a model would be sent, and asks none",
            used=("backtrack",),
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
    "solves the problem of seed 0; where no model is named, a stand-in draws the numbers",
)
"""A domain whose world is simulated by PyBullet."""
