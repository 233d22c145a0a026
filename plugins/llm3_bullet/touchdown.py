"""Coming straight down on a spot, doing something there, and going straight up again.

Grasping from above and putting down are both such a touchdown. What comes before it is a path in free space, which is
the motion planner's business; what happens here is checked piece by piece while the goals of that path are made.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass

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


@dataclass(frozen=True, eq=False)
class Touchdown:
    """One way to do it."""

    tool: Array
    """Pose of the tool frame at the bottom, (4, 4), in the world frame."""
    down: Scene
    """What the robot must not touch on the way down, and what it holds then."""
    up: Scene
    """The same for the way up."""
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
        self, options: Sequence[Touchdown], near: Array, rng: np.random.Generator
    ) -> tuple[tuple[Goal, ...], Failure | None, Stats]:
        """Goals for the planner, or why there are none.

        Args:
            options: Ways to do it, the preferred first.
            near: The configuration (dof,) that the robot comes from; goals near it come first within an option.
            rng: For the starts of inverse kinematics.

        Returns:
            The goals, at most `enough`; if there are none the failure, of the kind `UNREACHABLE` with how far the
            best attempt came short, or `GOAL_IN_COLLISION` with the contacts of the option that is least in the way;
            and what it cost.
        """
        goals: list[Goal] = []
        blocked: list[tuple[Contact, ...]] = []
        shortfalls: list[tuple[float, float]] = []
        stats = Stats()
        for option in options:
            answer = self._inverse.solve(option.tool, rng, near=near)
            stats += Stats(ik_calls=1)
            if not len(answer.solutions):
                shortfalls.append((answer.position_error, answer.rotation_error))
                continue
            down, up = self._checker.view(option.down), self._checker.view(option.up)
            for found in self._follow(option, down, up, answer.solutions):
                if isinstance(found, Goal):
                    goals.append(found)
                elif found:
                    blocked.append(found)
                else:
                    shortfalls.append((self._settings.height, 0.0))
                if len(goals) == self._settings.enough:
                    break
            stats += Stats(validity_checks=down.checks + up.checks)
            if len(goals) == self._settings.enough:
                break
        if goals:
            return tuple(goals), None, stats
        return (), _failure(blocked, shortfalls, stats), stats

    def _follow(
        self, option: Touchdown, down: SceneChecker, up: SceneChecker, bottoms: Array
    ) -> Iterator[Goal | tuple[Contact, ...]]:
        """For each configuration at the bottom: a goal, the contacts that forbid it, or () if the line breaks off."""
        allowed = -self._settings.tolerance
        top = option.tool.copy()
        top[2, 3] += self._settings.height
        lines, complete = straight_line(self._kinematics, bottoms, line_poses(option.tool, top, self._settings.spacing))
        for bottom, line, followed in zip(bottoms, lines, complete, strict=True):
            contacts = down.contacts(bottom, allowed) or up.contacts(bottom, allowed)
            if contacts or not followed:
                yield contacts
                continue
            rising = np.round(np.vstack([bottom, line]), ANGLE_DECIMALS) + 0.0  # states, too, are on this grid
            samples = self._samples(rising)
            for view in (down, up):
                free = view.valid(samples, allowed)
                if not free.all():
                    yield view.contacts(samples[int(np.argmin(free))], allowed)  # () where a joint limit is in the way
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


def _failure(blocked: list[tuple[Contact, ...]], shortfalls: list[tuple[float, float]], stats: Stats) -> Failure:
    if not blocked:
        position, rotation = min(shortfalls)
        return Failure(
            FailureKind.UNREACHABLE,
            measures={"position_error": position, "rotation_error": rotation},
            stats=stats,
        )
    contacts = min(blocked, key=lambda found: (len({c.object for c in found}), max(c.depth for c in found)))
    objects = tuple(dict.fromkeys(c.object for c in contacts))
    return Failure(FailureKind.GOAL_IN_COLLISION, objects=objects, contacts=contacts, stats=stats)
