"""What is where at one moment of a plan."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field

from llm3.types.frozen import FrozenDict
from llm3.types.state import Fact, Held, Pose, State


@dataclass(frozen=True)
class Moment:
    """A snapshot of a motion, for whoever draws it: unlike a `State` it may lie in the middle of an action."""

    configuration: tuple[float, ...] = ()
    """Joint values of the robot, to the last digit."""
    poses: Mapping[str, Pose] = field(default_factory=FrozenDict)
    """Of what stands somewhere, by name."""
    held: Held | None = None
    """What moves with the tool frame."""
    facts: Mapping[str, Fact] = field(default_factory=FrozenDict)
    opening: float | None = None
    """Distance between the fingers in metres; None where no motion has told it yet."""
    time: float = 0.0
    """Seconds since the beginning."""
    label: str = ""
    """What the robot is about, such as ``"approach"``; empty where it stands."""

    @property
    def state(self) -> State:
        """The same on the grid of states."""
        return State(self.poses, self.configuration, self.held, self.facts)


def moment_of(state: State, opening: float | None = None, time: float = 0.0) -> Moment:
    """The moment in which the world is in a state."""
    return Moment(state.configuration, state.poses, state.held, state.facts, opening, time)
