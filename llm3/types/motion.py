"""One motion-planning query and its answer."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, field
from enum import Enum

import numpy as np
from numpy.typing import ArrayLike, NDArray

from llm3.types.checks import finite
from llm3.types.failures import Contact
from llm3.types.state import Pose
from llm3.types.stats import Stats

Vector = NDArray[np.float64]
"""A configuration, shape (dof,), or several of them, shape (N, dof)."""
Mask = NDArray[np.bool_]
"""One verdict for each configuration, shape (N,)."""
Waypoints = tuple[tuple[float, ...], ...]
"""Configurations, one after another, joined by straight lines in joint space."""


def _no_contacts(_: Vector) -> tuple[Contact, ...]:
    return ()


class EventKind(str, Enum):
    """What happens at a standstill between two segments."""

    GRIPPER = "gripper"
    ATTACH = "attach"
    DETACH = "detach"


@dataclass(frozen=True)
class Event:
    """Something that happens while the arm stands still."""

    kind: EventKind
    opening: float | None = None
    """For `GRIPPER`: the distance between the fingers in metres."""
    object: str | None = None
    """For `ATTACH` and `DETACH`: the object."""
    grasp: Pose | None = None
    """For `ATTACH`: the object's pose in the tool frame."""


@dataclass(frozen=True)
class Segment:
    """A piece of motion, and the events that come before it."""

    label: str
    """What the piece is for, such as ``"transit"``, ``"approach"``, ``"lift"``, ``"descend"`` or ``"retreat"``."""
    waypoints: Waypoints
    events: tuple[Event, ...] = ()


@dataclass(frozen=True)
class Motion:
    """All that the robot does for one action; empty for an action without motion."""

    segments: tuple[Segment, ...] = ()

    @property
    def end(self) -> tuple[float, ...]:
        """The configuration in which the motion ends.

        Raises:
            ValueError: There is no motion, so the robot is where the state says.
        """
        if not self.segments:
            raise ValueError("this action has no motion: the robot stays in state.configuration")
        return self.segments[-1].waypoints[-1]

    @property
    def events(self) -> tuple[Event, ...]:
        """All events, in order."""
        return tuple(event for segment in self.segments for event in segment.events)


@dataclass(frozen=True)
class Goal:
    """A configuration that would do, and the straight pieces that follow once it is reached.

    The Env has checked those pieces (approach, grasp, lift, …) before it offers the goal.
    """

    configuration: tuple[float, ...]
    then: tuple[Segment, ...] = ()

    def __post_init__(self) -> None:
        object.__setattr__(self, "configuration", finite("a goal's configuration", self.configuration))


@dataclass(frozen=True, eq=False)
class MotionProblem:
    """Find a path in free space from `start` to any one of `goals`.

    The planner sees configurations and two functions, and no robot: a point in the plane is as good as an arm.
    """

    start: Vector
    """Shape (dof,)."""
    goals: tuple[Goal, ...]
    """At least one, the preferred first."""
    low: Vector
    """Lower joint limits, shape (dof,)."""
    high: Vector
    """Upper joint limits, shape (dof,)."""
    valid: Callable[[Vector], Mask]
    """Takes configurations (N, dof), answers which of them are free, (N,)."""
    resolution: Vector
    """Shape (dof,). Two neighbouring samples of an edge differ by Δq with Σ|Δq_j|/resolution_j ≤ 1."""
    explain: Callable[[Vector], tuple[Contact, ...]] = field(default=_no_contacts)
    """Takes one configuration (dof,), answers what touches what there, the deepest first."""
    label: str = "transit"
    """What the path is for; it names the path's segment in the plan."""
    before: tuple[Event, ...] = ()
    """What happens before the robot moves, such as opening the gripper."""
    stats: Stats = field(default=Stats())
    """What it cost to prepare the problem."""

    def __post_init__(self) -> None:
        start = np.array(self.start, dtype=float)
        finite("a start's configuration", start.ravel())
        if start.ndim != 1:
            raise ValueError(f"start must be one configuration of shape (dof,), not {start.shape}")
        if not self.goals:
            raise ValueError("a motion problem needs at least one goal")
        for goal in self.goals:
            if len(goal.configuration) != len(start):
                raise ValueError(f"a goal has {len(goal.configuration)} joint values, the start {len(start)}")
        object.__setattr__(self, "start", start)
        for name in ("low", "high", "resolution"):  # a scalar stands for the same value in every joint
            values = np.broadcast_to(np.asarray(getattr(self, name), dtype=float), start.shape)
            object.__setattr__(self, name, values)

    def motion(self, path: Path) -> Motion:
        """The whole motion of the action: the path, then the straight pieces of the goal it reached."""
        waypoints = tuple(_as_tuple(q) for q in path.waypoints)
        return Motion((Segment(self.label, waypoints, self.before), *self.goals[path.goal_index].then))


@dataclass(frozen=True)
class NoMotion:
    """The action is possible and the robot need not move for it."""

    stats: Stats = field(default=Stats(), compare=False)


@dataclass(frozen=True, eq=False)
class Path:
    """A collision-free path in joint space."""

    waypoints: Vector
    """Shape (N, dof), from the problem's start to the goal, joined by straight lines."""
    goal_index: int = 0
    """Which of the problem's goals was reached."""
    stats: Stats = field(default=Stats())

    @property
    def length(self) -> float:
        """Joint-space length: the sum of the Euclidean lengths of the pieces, in radians for an arm."""
        return float(np.linalg.norm(np.diff(self.waypoints, axis=0), axis=1).sum())


def _as_tuple(values: ArrayLike) -> tuple[float, ...]:
    return tuple(float(v) for v in np.asarray(values, dtype=float).ravel())
