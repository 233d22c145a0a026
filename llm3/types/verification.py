"""What a second look at a plan finds."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field

from llm3.types.frozen import FrozenDict


@dataclass(frozen=True)
class Defect:
    """Something in a plan that is not as it should be; its text says where and what, in one line."""

    sentence: str
    """What is wrong, with figures, such as ``"panda_hand touches blue_box, 3.20 mm deep"``."""
    number: int | None = None
    """Which action, counted from 1; None for what concerns the plan as a whole."""
    action: str = ""
    """That action, as a model would write it."""
    segment: str = ""
    """The label of the piece of motion; empty for what concerns the action as a whole."""
    waypoint: float | None = None
    """Where on the segment, counted from 0: 3.25 is a quarter of the way from waypoint 3 to waypoint 4."""
    time: float | None = None
    """When on the segment's trajectory, in seconds from its start; None for what concerns the waypoints."""
    measures: Mapping[str, float] = field(default_factory=FrozenDict)
    """Figures by name, such as ``{"depth": 0.0032}``; metres, radians, seconds."""

    def __post_init__(self) -> None:
        object.__setattr__(self, "measures", FrozenDict(self.measures))

    def __str__(self) -> str:
        """Such as ``"action 1 pick(['a'], {}), approach, waypoint 3.25: panda_hand touches b, 3.20 mm deep"``."""
        where = [
            f"action {self.number} {self.action}" if self.number else "",
            self.segment,
            "" if self.waypoint is None else f"waypoint {self.waypoint:.2f}",
            "" if self.time is None else f"{self.time:.3f} s",
        ]
        return ": ".join(filter(None, (", ".join(filter(None, where)), self.sentence)))


@dataclass(frozen=True)
class Verification:
    """What was looked at in a plan, and what is wrong with it."""

    defects: tuple[Defect, ...] = ()
    configurations: int = 0
    """How many configurations of the robot were looked at."""
    deepest_contact: float | None = None
    """The deepest contact that was seen, allowed or not, in metres; None where contacts are not measured."""
    clearances: Mapping[str, float] = field(default_factory=FrozenDict)
    """The smallest distance between the robot, with what it holds, and anything that it is not meant to touch there, in
    metres, by the label of the segment; negative where it touches. Labels in which nothing came near are missing."""

    def __post_init__(self) -> None:
        object.__setattr__(self, "clearances", FrozenDict(sorted(self.clearances.items())))

    @property
    def sound(self) -> bool:
        """Whether nothing is wrong."""
        return not self.defects
