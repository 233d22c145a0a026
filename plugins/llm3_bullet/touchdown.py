"""Coming straight down on a spot, doing something there, and going straight up again.

Grasping from above and putting down are both such a touchdown. What comes before it is a path in free space, which is
the motion planner's business; what happens here is checked piece by piece while the goals of that path are made.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from llm3.types import Contact, Event, Failure, FailureKind, Goal, Segment, Stats
from llm3.types.state import ANGLE_DECIMALS
from llm3_bullet.collision import CollisionChecker, SceneChecker
from llm3_bullet.inverse import InverseKinematics
from llm3_bullet.kinematics import Kinematics
from llm3_bullet.scene import Scene
from llm3_bullet.straight import line_poses, straight_line

Array = NDArray[np.float64]


CUT_SHORT = "The arm can reach the spot, but it cannot come straight down on it and go straight up again."
"""The detail of a failure `UNREACHABLE` where a joint limit, or a turn of the arm, interrupts the straight piece."""


@dataclass(frozen=True, eq=False)
class Touchdown:
    """One way to do it."""

    tool: Array
    """Pose of the tool frame at the bottom, (4, 4), in the world frame."""
    down: Scene
    """What the robot must not touch on the way down, and what it holds then."""
    up: Scene
    """The same for the way up."""
    after: Scene
    """The same for the path that follows, which begins where the way up ends."""
    before: tuple[Event, ...]
    """What happens before the way down, such as opening the gripper to the width of a box."""
    bottom: tuple[Event, ...]
    """What happens at the bottom, such as closing the gripper and attaching a box."""


@dataclass(frozen=True)
class TouchdownSettings:
    """Lengths in metres."""

    height: float = 0.1
    """How far above the bottom the straight piece begins and ends."""
    spacing: float = 0.01
    """Distance between the waypoints of a straight piece."""
    step: float = 0.002
    """Distance between the configurations that are tested for collision on a straight piece."""
    tolerance: float = 0.0005
    """Penetration that is no collision: a box that rests on another touches it, give or take the rounding of states."""
    enough: int = 3
    """How many goals are offered to the planner at most."""


class _Views(NamedTuple):
    """The checkers of a touchdown's scenes."""

    down: SceneChecker
    up: SceneChecker
    after: SceneChecker


@dataclass(frozen=True, eq=False)
class _Blocked:
    """A configuration on the way that is not free."""

    configuration: Array
    contacts: tuple[Contact, ...]


class TouchdownPlanner:
    """Finds the configurations above a spot from which the robot can touch down and get away again."""

    def __init__(
        self,
        kinematics: Kinematics,
        inverse: InverseKinematics,
        checker: CollisionChecker,
        settings: TouchdownSettings = TouchdownSettings(),  # frozen
    ) -> None:
        self._kinematics, self._inverse, self._checker, self._settings = kinematics, inverse, checker, settings

    def goals(
        self, options: Sequence[Touchdown], near: Array, clearance: float, rng: np.random.Generator
    ) -> tuple[tuple[Goal, ...], Failure | None, Stats]:
        """Goals for the planner, or why there are none.

        Args:
            options: Ways to do it, the preferred first.
            near: The configuration (dof,) that the robot comes from; goals near it come first within an option.
            clearance: What paths in free space keep, in metres: a goal has it too, or the next path could not begin.
            rng: For the starts of inverse kinematics.

        Returns:
            The goals, at most `enough`; if there are none the failure, of the kind `UNREACHABLE` with how far the
            best attempt came short, or `GOAL_IN_COLLISION` with the contacts of the option that is least in the way;
            and what it cost.
        """
        goals: list[Goal] = []
        blocked: list[_Blocked] = []
        shortfalls: list[tuple[float, float]] = []
        cut_short = False
        stats = Stats()
        for option in options:
            answer = self._inverse.solve(option.tool, rng, near=near)
            stats += Stats(ik_calls=1)
            if not len(answer.solutions):
                shortfalls.append((answer.position_error, answer.rotation_error))
                continue
            views = _Views(*(self._checker.view(scene) for scene in (option.down, option.up, option.after)))
            for found in self._follow(option, views, answer.solutions, clearance):
                if isinstance(found, Goal):
                    goals.append(found)
                elif found.contacts:
                    blocked.append(found)
                else:
                    cut_short = True
                if len(goals) == self._settings.enough:
                    break
            stats += Stats(validity_checks=sum(view.checks for view in views))
            if len(goals) == self._settings.enough:
                break
        if goals:
            return tuple(goals), None, stats
        return (), _failure(blocked, cut_short, shortfalls, stats), stats

    def _follow(self, option: Touchdown, views: _Views, bottoms: Array, clearance: float) -> Iterator[Goal | _Blocked]:
        """For each configuration at the bottom: a goal, or where it is blocked, without contacts if the line ends."""
        allowed = -self._settings.tolerance
        above = option.tool.copy()
        above[2, 3] += self._settings.height
        poses = line_poses(option.tool, above, self._settings.spacing)
        for bottom, ascent, followed in zip(bottoms, *straight_line(self._kinematics, bottoms, poses), strict=True):
            contacts = views.down.contacts(bottom, allowed) or views.up.contacts(bottom, allowed)
            if contacts or not followed:
                yield _Blocked(bottom, contacts)
                continue
            rising = np.round(np.vstack([bottom, ascent]), ANGLE_DECIMALS) + 0.0  # states, too, are on this grid
            samples = self._samples(rising)
            top = samples[-1:]
            for view, line, gap in (
                (views.down, samples, allowed),
                (views.up, samples, allowed),
                (views.after, top, clearance),
            ):
                free = view.valid(line, gap)
                if not free.all():
                    q = line[int(np.argmin(free))]
                    yield _Blocked(q, view.contacts(q, gap))  # no contacts where a joint limit is in the way
                    break
            else:
                yield self._goal(option, rising)

    def _samples(self, line: Array) -> Array:
        """The straight piece at the step of collision tests, joined linearly between its waypoints."""
        parts = max(1, int(np.ceil(self._settings.spacing / self._settings.step)))
        at = np.linspace(0, len(line) - 1, (len(line) - 1) * parts + 1)
        index = np.minimum(at.astype(int), len(line) - 2)
        weight = (at - index)[:, None]
        return np.asarray(line[index] * (1 - weight) + line[index + 1] * weight)

    def _goal(self, option: Touchdown, line: Array) -> Goal:
        rising = tuple(tuple(map(float, q)) for q in line)
        return Goal(
            rising[-1],
            (
                Segment("descend" if option.down.held else "approach", rising[::-1], option.before),
                Segment("lift" if option.up.held else "retreat", rising, option.bottom),
            ),
        )


def _failure(blocked: list[_Blocked], cut_short: bool, shortfalls: list[tuple[float, float]], stats: Stats) -> Failure:
    """What is told of options that all fail: the nearest to a success counts."""
    if not blocked and cut_short:
        return Failure(FailureKind.UNREACHABLE, CUT_SHORT, stats=stats)
    if not blocked:
        position, rotation = min(shortfalls)
        measures = {"position_error": position, "rotation_error": rotation}
        return Failure(FailureKind.UNREACHABLE, measures=measures, stats=stats)
    least = min(blocked, key=lambda b: (len({c.object for c in b.contacts}), max(c.depth for c in b.contacts)))
    return Failure(
        FailureKind.GOAL_IN_COLLISION,
        objects=tuple(dict.fromkeys(c.object for c in least.contacts)),
        contacts=least.contacts,
        configuration=tuple(least.configuration.tolist()),
        stats=stats,
    )
