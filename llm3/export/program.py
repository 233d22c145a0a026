"""What a robot is to do, in order: the noun between a plan and the files that hold it."""

from __future__ import annotations

from dataclasses import dataclass, replace
from itertools import pairwise

from llm3.types import Event, EventKind, Trajectory

LARGEST_NUMBER = 10**9
"""Of an action: every file format holds it."""
TIME_DECIMALS = 9
"""Digits of a time in seconds after the point."""
LONGEST = 1e6
"""Seconds: every nanosecond of it is a number of its own."""


@dataclass(frozen=True)
class Deed:
    """What the gripper does while the arm stands still."""

    action: int
    """Which action of the plan it belongs to, counted from 1."""
    text: str
    """That action, as a model would write it."""
    event: Event

    def __post_init__(self) -> None:
        _check_action(self.action, self.text)
        kind, opening, name, grasp = self.event.kind, self.event.opening, self.event.object, self.event.grasp
        if kind is EventKind.GRIPPER:
            if opening is None or not 0 <= opening <= 1e3 or name is not None or grasp is not None:
                raise ValueError(
                    f"an event of kind gripper has an opening from 0 to 1000 m and nothing else, not {self.event}"
                )
        elif opening is not None or name is None or (kind is EventKind.DETACH and grasp is not None):
            what = "an object, perhaps a grasp," if kind is EventKind.ATTACH else "an object"
            raise ValueError(f"an event of kind {kind.value} has {what} and nothing else, not {self.event}")
        else:
            _check_name("an object", name)


@dataclass(frozen=True)
class Move:
    """A motion of the arm, from standstill to standstill."""

    action: int
    """Which action of the plan it belongs to, counted from 1."""
    text: str
    """That action, as a model would write it."""
    segment: str
    """What the motion is for, such as ``"approach"``."""
    trajectory: Trajectory
    """Its times are rounded to nanoseconds, which is what messages tell."""

    def __post_init__(self) -> None:
        _check_action(self.action, self.text)
        _check_name("a segment", self.segment)
        if self.trajectory.duration > LONGEST:
            raise ValueError(f"a motion may take {LONGEST:g} s, not {self.trajectory.duration:g} s")
        times = tuple(round(time, TIME_DECIMALS) for time in self.trajectory.times)
        object.__setattr__(self, "trajectory", replace(self.trajectory, times=times))


@dataclass(frozen=True)
class Program:
    """Everything that a robot does for a plan, in order. No joint values are told but in moves.

    Where a plan is a statement about a world, with states and grasps, this is what a controller needs.
    """

    joints: tuple[str, ...]
    """The names of the joints, in the order of the values of a trajectory."""
    units: tuple[str, ...]
    """The unit of each joint: ``"rad"`` or ``"m"``."""
    items: tuple[Deed | Move, ...]
    """What is done, one after another."""

    def __post_init__(self) -> None:
        if not self.joints or len(set(self.joints)) < len(self.joints):
            raise ValueError(f"a program needs joints with different names, not {', '.join(self.joints) or 'none'}")
        if len(self.units) != len(self.joints):
            raise ValueError(f"each of the {len(self.joints)} joints needs a unit, and there are {len(self.units)}")
        for name in self.joints:
            _check_name("a joint", name)
        for unit in self.units:
            _check_name("a unit", unit)
            if set(unit) & set("[]"):
                raise ValueError(f"a unit has no brackets, and {unit!r} has")
        for before, after in pairwise(self.items):
            if after.action < before.action or (after.action == before.action and after.text != before.text):
                raise ValueError(
                    f"action {after.action} {after.text} cannot follow action {before.action} {before.text}"
                )
        for item in self.items:
            if isinstance(item, Move) and len(item.trajectory.positions[0]) != len(self.joints):
                raise ValueError(
                    f"{item.segment} of action {item.action} has {len(item.trajectory.positions[0])} joint values, and "
                    f"there are {len(self.joints)} joints"
                )

    @property
    def duration(self) -> float:
        """How long the arm moves, in seconds; deeds are not counted."""
        return sum(item.trajectory.duration for item in self.items if isinstance(item, Move))


def _check_action(number: int, text: str) -> None:
    if not 1 <= number <= LARGEST_NUMBER:
        raise ValueError(f"the number of an action must be from 1 to {LARGEST_NUMBER}, not {number}")
    _check_name("an action", text)


def _check_name(what: str, name: str | None) -> None:
    """See that a name survives in every format: one line, and no surrogates."""
    if not name or not name.isprintable():
        raise ValueError(f"the name of {what} must be one line of printable characters, not {name!r}")
