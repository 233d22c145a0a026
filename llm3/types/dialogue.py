"""What goes to a language model and what comes back."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field
from math import inf
from typing import Any, Literal

import numpy as np

from llm3.types.actions import ActionSchema
from llm3.types.checks import finite, texts
from llm3.types.failures import FailureKind
from llm3.types.frozen import FrozenDict
from llm3.types.stats import Stats

Property = str | int | float | tuple[float, ...]
Role = Literal["system", "user", "assistant"]


@dataclass(frozen=True)
class Message:
    """One message of a chat."""

    role: Role
    content: str


@dataclass(frozen=True)
class Entity:
    """A thing in the world as the model reads it: a name and what is known of it.

    Numbers are written into the prompt as they are, so round them here (to the millimetre, say).
    """

    name: str
    properties: Mapping[str, Property] = field(default_factory=FrozenDict)
    """Such as ``{"position": (0.39, -0.2, 0.035), "size": (0.07, 0.07, 0.07), "yaw": 0.0}``; SI units."""

    def __post_init__(self) -> None:
        properties = {name: _property(self.name, name, value) for name, value in self.properties.items()}
        object.__setattr__(self, "properties", FrozenDict(properties))


def _property(entity: str, name: str, value: Any) -> Property:
    """The value as plain Python: numpy's scalars and arrays become numbers and tuples."""
    plain = value.tolist() if isinstance(value, np.generic | np.ndarray) else value
    if isinstance(plain, list | tuple):
        return finite(f"{name} of {entity}", plain)
    if isinstance(plain, str | int | float):
        return plain
    raise TypeError(f"{name} of {entity} must be a text, a number or a tuple of numbers, not {value!r}")


@dataclass(frozen=True)
class Sketch:
    """A symbolic action whose parameters are still open, such as ``place(['red_box'], …)``."""

    name: str
    objects: tuple[str, ...] = ()

    def __post_init__(self) -> None:
        object.__setattr__(self, "objects", texts(f"the objects of {self.name!r}", self.objects))

    def __str__(self) -> str:
        return f"{self.name}({list(self.objects)!r}, ...)"


@dataclass(frozen=True)
class Remark:
    """What the model is told about one action of an earlier plan."""

    action: str
    """The action as the model wrote it."""
    verdict: Literal["feasible", "failed", "not tried"]
    text: str = ""
    """Why, or what happened besides."""
    kind: FailureKind | None = None
    """The kind of failure that the text tells, for stand-ins, which cannot read prose; None if it tells none."""


@dataclass(frozen=True)
class Feedback:
    """What the model is told about one earlier attempt."""

    attempt: int
    """Counted from 1."""
    remarks: tuple[Remark, ...] = ()
    """One for each action of the plan, in order; empty when no plan could be read."""
    summary: str = ""
    """About the attempt as a whole: what of the goal is missing, or why the reply could not be read."""


@dataclass(frozen=True)
class Context:
    """All that a prompt is rendered from, and nothing that the prompt leaves out."""

    task: str
    """What the world, the robot and the goal are, in the domain's words."""
    actions: tuple[ActionSchema, ...]
    objects: tuple[str, ...]
    """The names that an action may take."""
    state: tuple[Entity, ...]
    """The initial state."""
    trace: tuple[Feedback, ...] = ()
    """Earlier attempts, oldest first."""
    skeleton: tuple[Sketch, ...] = ()
    """The given action sequence, for strategies that fix it."""

    def __post_init__(self) -> None:
        object.__setattr__(self, "objects", texts("the objects of an Env", self.objects))


@dataclass(frozen=True)
class Request:
    """A question to a language model."""

    messages: tuple[Message, ...]
    context: Context
    """What the messages were rendered from: for stand-ins, which cannot read prose. A real model never sees it."""
    seed: int = 0
    """For stand-ins that draw: derived from the run's seed and the number of the call."""
    schema: Mapping[str, Any] = field(default_factory=FrozenDict)
    """The JSON schema of the asked-for reply, for servers that can hold a model to one; empty where there is none."""
    seconds: float = inf
    """How long the answer may take."""


@dataclass(frozen=True)
class Completion:
    """A language model's answer."""

    text: str
    stats: Stats = Stats()
    """Tokens and retries that it cost."""
    model: str = ""
    """The model as the server names it."""
    finish_reason: str = ""
    """Why the text ends, as the server says, such as ``"stop"``; ``"length"`` where a limit cut it off."""
    reasoning: str = ""
    """What the model thought before it answered, where the server tells. It is no part of the answer."""
    notes: tuple[str, ...] = ()
    """What it took to get the answer, a line for each retry and each feature that the server refused."""

    @property
    def cut_off(self) -> bool:
        """Whether a limit ended it."""
        return self.finish_reason == "length"

    def __post_init__(self) -> None:
        # A server may escape half of a surrogate pair, which no file can hold.
        for name in ("text", "reasoning"):
            object.__setattr__(self, name, getattr(self, name).encode(errors="replace").decode())
        object.__setattr__(self, "notes", texts("the notes of a completion", self.notes))
