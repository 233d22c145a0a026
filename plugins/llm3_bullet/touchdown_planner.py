"""Finds the ways to touch down on a spot.

What comes before a touchdown is a path in free space, which is the motion planner's business; what happens in it is
checked piece by piece while the goals of that path are made.
"""

from __future__ import annotations

from collections.abc import Iterable, Iterator
from dataclasses import dataclass
from itertools import chain, islice
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from llm3.types import Contact, Failure, FailureKind, Goal, Goals, Segment, Stats
from llm3.types.state import ANGLE_DECIMALS
from llm3_bullet.collision import CollisionChecker, SceneChecker
from llm3_bullet.inverse import InverseKinematics
from llm3_bullet.kinematics import Kinematics
from llm3_bullet.scene import Scene
from llm3_bullet.straight import line_poses, straight_line
from llm3_bullet.touchdown import CUT_SHORT, Touchdown, TouchdownSettings

Array = NDArray[np.float64]


class TouchdownPlanner:
    """Finds the configurations above a spot from which the robot can touch down and get away again."""

    def __init__(
        self,
        kinematics: Kinematics,
        inverse: InverseKinematics,
        checker: CollisionChecker,
        settings: TouchdownSettings,
    ) -> None:
        self._kinematics, self._inverse, self._checker, self._settings = kinematics, inverse, checker, settings

    def goals(
        self, options: Iterable[Touchdown], near: Array, clearance: float, rng: np.random.Generator
    ) -> Goals | Failure:
        """Goals for the planner, or why there are none.

        Args:
            options: Ways to do it, the preferred first.
            near: The configuration (dof,) that the robot comes from; goals near it come first within an option.
            clearance: What paths in free space keep, in metres: a goal has it too, or the next path could not begin.
            rng: For the starts of inverse kinematics.

        Returns:
            The goals, at most `enough`, of which the first is made already; or a failure of the kind `UNREACHABLE`
            with how far the best attempt came short, or `GOAL_IN_COLLISION` with the contacts of the option that is
            least in the way.
        """
        search = _Search(self._kinematics, self._inverse, self._checker, self._settings, near, clearance, rng)
        found = islice(search.goals(options), self._settings.enough)
        first = next(found, None)
        return search.failure() if first is None else Goals(chain((first,), found), search.cost)


class _Views(NamedTuple):
    """The checkers of a touchdown's scenes."""

    down: SceneChecker
    up: SceneChecker
    after: SceneChecker


@dataclass(frozen=True, eq=False)
class _Blocked:
    """A configuration on the way that is not free, and what tells why."""

    configuration: Array
    views: tuple[SceneChecker, ...]
    gap: float

    def contacts(self) -> tuple[Contact, ...]:
        """What is in the way in the first view in which anything is; nothing where a joint limit is."""
        return next(filter(None, (view.contacts(self.configuration, self.gap) for view in self.views)), ())


class _Search:
    """One search for goals, and what it found in the way."""

    def __init__(
        self,
        kinematics: Kinematics,
        inverse: InverseKinematics,
        checker: CollisionChecker,
        settings: TouchdownSettings,
        near: Array,
        clearance: float,
        rng: np.random.Generator,
    ) -> None:
        self._kinematics, self._inverse, self._checker, self._settings = kinematics, inverse, checker, settings
        self._near, self._clearance, self._rng = near, clearance, rng
        self._views: dict[Scene, SceneChecker] = {}
        self._blocked: list[_Blocked] = []
        self._shortfalls: list[tuple[float, float]] = []
        self._ik_calls = 0
        self._cut_short = False

    def cost(self) -> Stats:
        """What it cost so far."""
        checks = sum(view.checks for view in self._views.values())
        return Stats(ik_calls=self._ik_calls, validity_checks=checks)

    def goals(self, options: Iterable[Touchdown]) -> Iterator[Goal]:
        """The goals, one by one."""
        for option in options:
            answer = self._inverse.solve(option.tool, self._rng, near=self._near)
            self._ik_calls += 1
            if not answer.reached:
                self._shortfalls.append((answer.position_error, answer.rotation_error))
                continue
            views = _Views(*map(self._view, (option.down, option.up, option.after)))
            yield from self._above(option, views, answer.solutions)

    def failure(self) -> Failure:
        """Why there are no goals: of the options that all fail, the nearest to a success counts."""
        explained = [(blocked.configuration, blocked.contacts()) for blocked in self._blocked]
        touching = [(configuration, contacts) for configuration, contacts in explained if contacts]
        if touching:
            configuration, contacts = min(
                touching, key=lambda found: (len({c.object for c in found[1]}), max(c.depth for c in found[1]))
            )
            return Failure(
                FailureKind.GOAL_IN_COLLISION,
                objects=tuple(dict.fromkeys(contact.object for contact in contacts)),
                contacts=contacts,
                configuration=tuple(configuration.tolist()),
                stats=self.cost(),
            )
        if explained or self._cut_short:
            return Failure(FailureKind.UNREACHABLE, CUT_SHORT, stats=self.cost())
        position, rotation = min(self._shortfalls)
        measures = {"position_error": position, "rotation_error": rotation}
        return Failure(FailureKind.UNREACHABLE, measures=measures, stats=self.cost())

    def _view(self, scene: Scene) -> SceneChecker:
        if scene not in self._views:  # several ways to do it share scenes
            self._views[scene] = self._checker.view(scene)
        return self._views[scene]

    def _above(self, option: Touchdown, views: _Views, bottoms: Array) -> Iterator[Goal]:
        """The goals above configurations (K, dof) at the bottom."""
        allowed = -self._settings.tolerance
        above = option.tool.copy()
        above[2, 3] += self._settings.height
        poses = line_poses(option.tool, above, self._settings.spacing)
        free_at_bottom = views.down.valid(bottoms, allowed)
        if free_at_bottom.any():
            free_at_bottom[free_at_bottom] = views.up.valid(bottoms[free_at_bottom], allowed)
        for bottom, free in zip(bottoms, free_at_bottom, strict=True):
            if not free:
                self._blocked.append(_Blocked(bottom, views[:2], allowed))
                continue
            (ascent,), (followed,) = straight_line(self._kinematics, bottom[None], poses)
            if not followed:
                self._cut_short = True
                continue
            rising = np.round(np.vstack([bottom, ascent]), ANGLE_DECIMALS) + 0.0  # states, too, are on this grid
            blocked = self._blocked_on(rising, views)
            if blocked:
                self._blocked.append(blocked)
            else:
                yield _goal(option, rising)

    def _blocked_on(self, rising: Array, views: _Views) -> _Blocked | None:
        """The first obstacle on the way down, on the way up, or where the next path begins."""
        allowed = -self._settings.tolerance
        samples = _samples(rising, max(1, int(np.ceil(self._settings.spacing / self._settings.step))))
        for view, line, gap in (
            (views.down, samples, allowed),
            (views.up, samples, allowed),
            (views.after, samples[-1:], self._clearance),
        ):
            free = view.valid(line, gap)
            if not free.all():
                return _Blocked(line[int(np.argmin(free))], (view,), gap)
        return None


def _samples(line: Array, parts: int) -> Array:
    """A line (M, dof) with each piece between two waypoints, which is straight in joint space, cut into so many."""
    at = np.linspace(0, len(line) - 1, (len(line) - 1) * parts + 1)
    index = np.minimum(at.astype(int), len(line) - 2)
    weight = (at - index)[:, None]
    return np.asarray(line[index] * (1 - weight) + line[index + 1] * weight)


def _goal(option: Touchdown, line: Array) -> Goal:
    rising = tuple(map(tuple, line.tolist()))
    return Goal(
        rising[-1],
        (
            Segment("descend" if option.down.held else "approach", rising[::-1], option.before),
            Segment("lift" if option.up.held else "retreat", rising, option.bottom),
        ),
    )
