"""The state of the world: all that the future depends on."""

from __future__ import annotations

from collections.abc import Iterable, Mapping
from dataclasses import dataclass, field
from typing import Any

import numpy as np

from llm3.types.checks import finite, texts
from llm3.types.frozen import FrozenDict

LENGTH_DECIMALS = 4
"""Lengths in a state are rounded to 0.1 mm."""
ANGLE_DECIMALS = 4
"""Joint values in a state are rounded to 1e-4 rad (0.1 mm for a prismatic joint)."""
QUATERNION_DECIMALS = 5
"""A quaternion's components are half-angles: 1e-5 keeps rotations well within 1e-4 rad."""

Fact = bool | int | float | str
"""The value of a fact. Keep to one type a name: True, 1 and 1.0 are equal in Python, but not in a record."""


def rounded(values: Iterable[float], decimals: int) -> tuple[float, ...]:
    """The values as rounded floats, with -0.0 made 0.0 so that equal numbers are written alike."""
    return tuple(round(float(v), decimals) + 0.0 for v in values)


@dataclass(frozen=True)
class Pose:
    """A rigid-body pose, rounded to the grid of states."""

    position: tuple[float, ...]
    """x, y, z in metres."""
    orientation: tuple[float, ...] = (0.0, 0.0, 0.0, 1.0)
    """A unit quaternion x, y, z, w; of the two signs the one whose last non-zero component is positive."""

    def __post_init__(self) -> None:
        if len(self.position) != 3 or len(self.orientation) != 4:
            raise ValueError("a pose has a position of 3 numbers and an orientation of 4 (x, y, z, w)")
        if not 0.99 < sum(c * c for c in self.orientation) < 1.01:
            raise ValueError(f"an orientation is a unit quaternion x, y, z, w, not {tuple(self.orientation)}")
        quaternion = rounded(self.orientation, QUATERNION_DECIMALS)
        last = next((c for c in reversed(quaternion) if c), 0.0)
        if last < 0:
            quaternion = rounded((-c for c in quaternion), QUATERNION_DECIMALS)
        object.__setattr__(self, "position", rounded(finite("a position", self.position), LENGTH_DECIMALS))
        object.__setattr__(self, "orientation", quaternion)


@dataclass(frozen=True)
class Held:
    """An object in the gripper: it moves with the tool frame."""

    object: str
    grasp: Pose
    """The object's pose in the tool frame."""


def _fact(name: str, value: Any) -> Fact:
    plain = value.item() if isinstance(value, np.generic) else value
    if not isinstance(plain, Fact):
        raise TypeError(f"fact {name!r} must be a bool, a number or a text, not {value!r}")
    return rounded(finite(f"fact {name!r}", (plain,)), LENGTH_DECIMALS)[0] if isinstance(plain, float) else plain


@dataclass(frozen=True)
class State:
    """A snapshot of the world, rounded so that equal means equal.

    An Env depends on nothing else: whatever it keeps beside it, such as a simulator, is a cache of this.
    """

    poses: Mapping[str, Pose] = field(default_factory=FrozenDict)
    """Object poses in the world frame, by name. A held object is in `held` instead."""
    configuration: tuple[float, ...] = ()
    """Joint values of the robot: radians, or metres for a prismatic joint."""
    held: Held | None = None
    facts: Mapping[str, Fact] = field(default_factory=FrozenDict)
    """Whatever else the future depends on, such as ``{"door_open": True}``. Floats are rounded like lengths."""

    def __post_init__(self) -> None:
        if self.held and self.held.object in self.poses:
            raise ValueError(f"{self.held.object!r} is held, so it has no pose of its own: leave it out of `poses`")
        object.__setattr__(self, "poses", FrozenDict(sorted(self.poses.items())))
        object.__setattr__(
            self, "configuration", rounded(finite("a configuration", self.configuration), ANGLE_DECIMALS)
        )
        facts = {name: _fact(name, value) for name, value in self.facts.items()}
        object.__setattr__(self, "facts", FrozenDict(sorted(facts.items())))


@dataclass(frozen=True)
class GoalStatus:
    """Whether the goal is reached and, if not, one sentence for each part of it that is missing."""

    achieved: bool
    unmet: tuple[str, ...] = ()

    def __post_init__(self) -> None:
        object.__setattr__(self, "unmet", texts("what is unmet of a goal", self.unmet))
        if self.achieved == bool(self.unmet):
            raise ValueError("a goal is either achieved or has unmet parts: name each of them in `unmet`")


@dataclass(frozen=True)
class Transition:
    """What an action did: the next state, and what physics did against the plan."""

    state: State
    notes: tuple[str, ...] = ()
    """Sentences such as ``"red_box slid 12 mm"``, which every model is told."""

    def __post_init__(self) -> None:
        object.__setattr__(self, "notes", texts("the notes of a transition", self.notes))
