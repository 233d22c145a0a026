"""One motion-planning query and its answer."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Sequence
from dataclasses import dataclass, field
from enum import Enum
from typing import overload

import numpy as np
from numpy.typing import ArrayLike, NDArray

from llm3.errors import LLM3Error, PluginError
from llm3.types.checks import finite
from llm3.types.failures import Contact
from llm3.types.state import ANGLE_DECIMALS, Pose
from llm3.types.stats import Stats
from llm3.types.trajectory import Trajectory

Vector = NDArray[np.float64]
"""A configuration, shape (dof,), or several of them, shape (N, dof)."""
Mask = NDArray[np.bool_]
"""One verdict for each configuration, shape (N,)."""
Waypoints = tuple[tuple[float, ...], ...]
"""Configurations, one after another, joined by straight lines in joint space."""


GRID = 10.0**-ANGLE_DECIMALS * 1.001
"""How far outside of its limits a joint value may be, as states are rounded."""


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
    trajectory: Trajectory | None = None
    """The same piece in time, from standstill to standstill; None where no times are known."""


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

    @property
    def duration(self) -> float | None:
        """How long the robot moves, in seconds, without the events; None where a segment has no trajectory."""
        if any(segment.trajectory is None for segment in self.segments):
            return None
        return sum(segment.trajectory.duration for segment in self.segments if segment.trajectory)


@dataclass(frozen=True)
class Goal:
    """A configuration that would do, and the straight pieces that follow once it is reached.

    The Env has checked those pieces (approach, grasp, lift, …) before it offers the goal.
    """

    configuration: tuple[float, ...]
    then: tuple[Segment, ...] = ()

    def __post_init__(self) -> None:
        object.__setattr__(self, "configuration", finite("a goal's configuration", self.configuration))


class Goals(Sequence[Goal]):
    """Goals in order of preference, each made when it is first looked at: most planners are content with the first."""

    def __init__(self, goals: Iterable[Goal], cost: Callable[[], Stats] = Stats) -> None:
        """Take the goals, ready or still to be made.

        Args:
            goals: At least one.
            cost: Answers what it cost to make those that are made by then.
        """
        self._made: list[Goal] = []
        self._left = iter(goals)
        self._cost = cost
        self._fault = ""
        if not self._reach(0):
            raise ValueError("a motion problem needs at least one goal")

    @property
    def stats(self) -> Stats:
        """What it cost to make those that were looked at."""
        return self._cost()

    def __len__(self) -> int:
        while self._reach(len(self._made)):
            pass
        return len(self._made)

    @overload
    def __getitem__(self, index: int) -> Goal: ...

    @overload
    def __getitem__(self, index: slice) -> Sequence[Goal]: ...

    def __getitem__(self, index: int | slice) -> Goal | Sequence[Goal]:
        if isinstance(index, slice) or index < 0:
            len(self)
        else:
            self._reach(index)
        return self._made[index]

    def _reach(self, index: int) -> bool:
        """Make goals up to this one; False if there are not so many."""
        while len(self._made) <= index:
            goal = self._next()
            if goal is None:
                return False
            self._made.append(goal)
        return True

    def _next(self) -> Goal | None:
        """Make one more goal; None if there is none. What fails here is the fault of who makes the goals."""
        if self._fault:
            raise PluginError(self._fault)
        try:
            goal = next(self._left, None)
            if goal and self._made and len(goal.configuration) != len(self._made[0].configuration):
                raise ValueError("all goals of a motion problem must have the same number of joint values")
        except LLM3Error:
            raise
        except Exception as error:
            self._fault = f"making goal {len(self._made)} raised {type(error).__name__}: {error}"
            raise PluginError(self._fault) from error
        return goal


@dataclass(frozen=True, eq=False)
class MotionProblem:
    """Find a path in free space from `start` to any one of `goals`.

    The planner sees configurations and two functions, and no robot: a point in the plane is as good as an arm.
    """

    start: Vector
    """Shape (dof,)."""
    goals: Sequence[Goal]
    """At least one, the preferred first, within the limits. They are stored as `Goals`."""
    low: Vector
    """Lower joint limits, shape (dof,). No planner leaves them."""
    high: Vector
    """Upper joint limits, shape (dof,)."""
    valid: Callable[[Vector], Mask]
    """Takes configurations (N, dof), answers which of them are free, (N,)."""
    resolution: Vector
    """Shape (dof,). Two neighbouring samples of an edge differ by Δq with Σ|Δq_j|/resolution_j ≤ 1."""
    uncertain: Callable[[Vector, Vector, int], Mask] | None = None
    """Saves tests. Takes both ends of a straight line and the number of even steps between its samples, answers which
    of the samples, (steps + 1,), need a test. The others are certainly free."""
    explain: Callable[[Vector], tuple[Contact, ...]] = field(default=_no_contacts)
    """Takes one configuration (dof,), answers what touches what there, the deepest first."""
    label: str = "transit"
    """What the path is for; it names the path's segment in the plan."""
    before: tuple[Event, ...] = ()
    """What happens before the robot moves, such as opening the gripper."""
    stats: Stats = field(default=Stats())
    """What it cost to prepare the problem, the goals aside."""

    @property
    def cost(self) -> Stats:
        """What it cost so far to prepare the problem and the goals that were looked at."""
        return self.stats + (self.goals.stats if isinstance(self.goals, Goals) else Stats())

    def __post_init__(self) -> None:
        start = np.array(self.start, dtype=float)
        finite("a start's configuration", start.ravel())
        if start.ndim != 1:
            raise ValueError(f"start must be one configuration of shape (dof,), not {start.shape}")
        object.__setattr__(self, "start", start)
        for name in ("low", "high", "resolution"):  # a scalar stands for the same value in every joint
            values = np.broadcast_to(np.asarray(getattr(self, name), dtype=float), start.shape)
            object.__setattr__(self, name, values)
        self._hold("the start", start)
        given = self.goals
        if isinstance(given, Goals):  # not all may be made yet
            object.__setattr__(self, "goals", Goals(map(self._checked, given), lambda: given.stats))
        else:
            object.__setattr__(self, "goals", Goals([self._checked(goal) for goal in given]))

    def _checked(self, goal: Goal) -> Goal:
        if len(goal.configuration) != len(self.start):
            raise ValueError(f"a goal has {len(goal.configuration)} joint values, the start {len(self.start)}")
        self._hold("a goal", np.array(goal.configuration))
        return goal

    def _hold(self, what: str, configuration: Vector) -> None:
        """See that the limits are kept, to within the rounding of states."""
        outside = (configuration < self.low - GRID) | (configuration > self.high + GRID)
        for joint in np.flatnonzero(outside & (self.low <= self.high))[:1]:  # of other limits `FreeSpace` tells
            raise ValueError(
                f"joint value {joint} of {what} is {configuration[joint]:.6g}, outside of its limits "
                f"{self.low[joint]:.6g} to {self.high[joint]:.6g}: refuse an action that would need it, or widen `low` "
                "and `high`"
            )

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

    @property
    def turning(self) -> float:
        """How far from smooth it is: the sum of the angles, in joint space, by which it turns at its waypoints.

        In radians: 0 for a straight line, π for each reversal; waypoints on a straight line add nothing.

        Source: the total curvature of a polygon, J. W. Milnor, "On the total curvature of knots", Annals of
        Mathematics 52, 1950.
        """
        pieces = np.diff(self.waypoints, axis=0)
        lengths = np.linalg.norm(pieces, axis=1)
        directions = pieces[lengths > 0] / lengths[lengths > 0, None]
        sums, differences = directions[1:] + directions[:-1], directions[1:] - directions[:-1]
        # Exact for small angles, too, where the arc cosine is not.
        angles = 2 * np.arctan2(np.linalg.norm(differences, axis=1), np.linalg.norm(sums, axis=1))
        return float(angles.sum())


def _as_tuple(values: ArrayLike) -> tuple[float, ...]:
    return tuple(float(v) for v in np.asarray(values, dtype=float).ravel())
