"""Symbolic actions with continuous parameters, and the schemas that say which ones there are."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field

from llm3.types.checks import finite, texts
from llm3.types.frozen import FrozenDict


@dataclass(frozen=True)
class Parameter:
    """A continuous parameter of an action: any value from `low` to `high`, both included."""

    name: str
    low: float
    high: float
    unit: str = ""
    """The unit as the model reads it, such as ``"m"`` or ``"rad"``."""

    def __post_init__(self) -> None:
        finite(f"the range of parameter {self.name!r}", (self.low, self.high))
        if self.low > self.high:
            raise ValueError(f"parameter {self.name!r} has a range from {self.low} to {self.high}, which is empty")


@dataclass(frozen=True)
class ActionSchema:
    """A primitive action: what it takes and what it does.

    The ranges in a prompt, the checks on a reply and the random sampler all come from here.
    """

    name: str
    objects: tuple[str, ...] = ()
    """What each object argument stands for, in order, such as ``("box",)``."""
    parameters: tuple[Parameter, ...] = ()
    description: str = ""
    """One sentence for the model, without a full stop, such as ``"pick up the box from above"``."""

    def __post_init__(self) -> None:
        if not self.name.isidentifier():
            raise ValueError(f"an action's name must be letters, digits and underscores, not {self.name!r}")
        object.__setattr__(self, "objects", texts(f"the objects of action {self.name!r}", self.objects))
        object.__setattr__(self, "parameters", tuple(self.parameters))
        names = [parameter.name for parameter in self.parameters]
        if len(set(names)) < len(names):
            raise ValueError(f"action {self.name!r} has two parameters of one name: {', '.join(names)}")


@dataclass(frozen=True)
class Action:
    """A ground action, such as ``place(['red_box'], {'x': 0.5, 'y': 0.0, 'theta': 0.0})``."""

    name: str
    objects: tuple[str, ...] = ()
    params: Mapping[str, float] = field(default_factory=FrozenDict)
    """Values by parameter name, in the schema's order and units."""

    def __post_init__(self) -> None:
        object.__setattr__(self, "objects", texts(f"the objects of {self.name!r}", self.objects))
        # -0.0 is made 0.0: equal actions must be written alike, for their text seeds what is drawn for them.
        object.__setattr__(self, "params", FrozenDict({k: float(v) + 0.0 for k, v in self.params.items()}))

    def __str__(self) -> str:
        """Exactly what a model writes; parsing it gives this action back, to the last bit."""
        return f"{self.name}({list(self.objects)!r}, {dict(self.params)!r})"
