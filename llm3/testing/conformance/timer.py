"""The check of a timer."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass
from itertools import pairwise

import numpy as np

from llm3.interfaces import TrajectoryTimer
from llm3.testing.conformance.complaint import Complaint, Report
from llm3.testing.conformance.inspection import Fault, Inspection
from llm3.testing.conformance.values import configuration
from llm3.types import Trajectory, Vector

INSTEAD = "there is a trajectory along every path, also along one that stands still"
NEAR = 1e-6
"""How near to a waypoint is through it."""
ASTRAY = 0.01
"""How far from the edges, which were checked for collision, is too far: rad, or m."""
TOLERANCE = 1.001
"""How many times a limit is still within it."""
STILL = 1e-9


@dataclass(frozen=True, eq=False)
class PathCase:
    """A path, and the limits of the joints."""

    name: str
    waypoints: Vector
    velocity: Vector
    acceleration: Vector


def _case(name: str, rows: list[list[float]], velocity: float = 1.0, acceleration: float = 2.0) -> PathCase:
    waypoints = np.array(rows)
    scale = np.linspace(1.0, 2.0, waypoints.shape[1])
    return PathCase(name, waypoints, velocity * scale, acceleration * scale)


def _cases() -> tuple[PathCase, ...]:
    rng = np.random.default_rng(0)
    t = np.linspace(0, 1, 12)[:, None]
    return (
        _case("one waypoint", [[0.3, -0.2]]),
        _case("a line", [[0.0], [1.0]]),
        _case("there and back", [[0.0, 0.0], [1.0, 0.5], [0.0, 0.0]]),
        _case("a corner", [[0.0, 0.0], [1.0, 0.0], [1.0, 1.0]]),
        _case("waypoints that repeat", [[0.0, 0.0], [0.0, 0.0], [0.5, 0.5], [0.5, 0.5]]),
        _case("a short way", [[0.0, 0.0], [1e-4, 0.0]]),
        _case("a curve", np.round(np.hstack([np.sin(t), np.cos(t), t]), 4).tolist()),
        _case("seven joints", np.cumsum(rng.normal(size=(6, 7)), axis=0).tolist(), 0.5, 1.0),
    )


class Timing:
    """A timer at work."""

    def __init__(self, timer: TrajectoryTimer) -> None:
        self.timer, self.cases = timer, _cases()

    def asked(self, case: PathCase) -> Trajectory:
        """The timer's answer."""
        return self.timer.time(case.waypoints.copy(), case.velocity.copy(), case.acceleration.copy())

    def answers(self) -> Iterator[tuple[PathCase, Trajectory]]:
        """Those that are trajectories of as many joints."""
        for case in self.cases:
            found = self.asked(case)
            if isinstance(found, Trajectory) and len(found.positions[0]) == case.waypoints.shape[1]:
                yield case, found


def answers_are_trajectories(timing: Timing) -> Iterator[Fault]:
    """The answer of time is a Trajectory with a value for each joint."""
    for case in timing.cases:
        found = timing.asked(case)
        if not isinstance(found, Trajectory) or len(found.positions[0]) != case.waypoints.shape[1]:
            yield Fault(f"{case.name}: time answers {found!r:.80}.", "It answers a Trajectory over the joints it got.")


def motions_begin_and_end_at_rest(timing: Timing) -> Iterator[Fault]:
    """A trajectory leads from standstill at the first waypoint to standstill at the last."""
    for case, found in timing.answers():
        for what, position, velocity, wanted in (
            ("begins", found.positions[0], found.velocities[0], case.waypoints[0]),
            ("ends", found.positions[-1], found.velocities[-1], case.waypoints[-1]),
        ):
            if not np.allclose(position, wanted, rtol=0, atol=STILL):
                yield Fault(
                    f"{case.name}: the motion {what} at {configuration(position)}, and not at {configuration(wanted)}.",
                    "The first and the last position are the ends of the path, to the last bit.",
                )
            if np.abs(velocity).max() > STILL:
                yield Fault(
                    f"{case.name}: the motion {what} with a velocity of {configuration(velocity)}.",
                    "Pieces are joined at a standstill: the first and the last velocity are 0.",
                )


def motions_pass_through_every_waypoint(timing: Timing) -> Iterator[Fault]:
    """Every waypoint is passed, in order, and the edges between them are not left."""
    for case, found in timing.answers():
        positions = found.sample(_times(found))[0]
        reached = 0
        for waypoint in case.waypoints:
            near = np.flatnonzero(np.abs(positions[reached:] - waypoint).max(axis=1) <= NEAR)
            if not len(near):
                yield Fault(
                    f"{case.name}: the motion does not pass through {configuration(waypoint)}.",
                    "Only the path itself was checked for collision: do not cut corners.",
                )
                break
            reached += int(near[0])
        away = np.min([_distances(positions, a, b) for a, b in _edges(case.waypoints)], axis=0)
        if away.max() > ASTRAY:
            yield Fault(
                f"{case.name}: the motion leaves the lines between the waypoints by {away.max():.3g}.",
                "A spline through the waypoints swings out: stop at corners, or add knots on the lines.",
            )


def motions_stay_within_the_limits(timing: Timing) -> Iterator[Fault]:
    """No joint is faster, or accelerates harder, than it may at any time."""
    for case, found in timing.answers():
        _, velocities, accelerations = found.sample(_times(found))
        for what, values, limits in (
            ("velocity", velocities, case.velocity),
            ("acceleration", accelerations, case.acceleration),
        ):
            share = (np.abs(values) / limits).max()
            if share > TOLERANCE:
                yield Fault(
                    f"{case.name}: the {what} reaches {share:.3g} times what the joint may.",
                    "Limits hold between the times of a trajectory, too, where it follows cubic polynomials.",
                )


def the_same_path_gives_the_same_times(timing: Timing) -> Iterator[Fault]:
    """The same arguments give the same trajectory, and are left alone."""
    for case in timing.cases:
        waypoints = case.waypoints.copy()
        first = timing.timer.time(waypoints, case.velocity.copy(), case.acceleration.copy())
        if not np.array_equal(waypoints, case.waypoints):
            yield Fault(f"{case.name}: time changes the waypoints that it is given.", "Work on a copy.")
            return
        if first != timing.asked(case):
            yield Fault(
                f"{case.name}: the same path gets two trajectories.", "A timer draws nothing and keeps nothing."
            )
            return


def _times(found: Trajectory) -> Vector:
    between = [np.linspace(a, b, 9) for a, b in pairwise(found.times)]
    return np.unique(np.concatenate([np.zeros(1), *between]))


def _edges(waypoints: Vector) -> list[tuple[Vector, Vector]]:
    return list(pairwise(waypoints)) or [(waypoints[0], waypoints[0])]


def _distances(points: Vector, start: Vector, end: Vector) -> Vector:
    way = end - start
    along = np.clip((points - start) @ way / max(float(way @ way), 1e-300), 0.0, 1.0)
    return np.asarray(np.linalg.norm(points - start - along[:, None] * way, axis=1))


RULES = (
    answers_are_trajectories,
    motions_begin_and_end_at_rest,
    motions_pass_through_every_waypoint,
    motions_stay_within_the_limits,
    the_same_path_gives_the_same_times,
)


def check_timer(timer: TrajectoryTimer) -> tuple[Complaint, ...]:
    """Look for faults in a timer, on a few paths."""
    return examine_timer(timer).complaints


def examine_timer(timer: TrajectoryTimer) -> Report:
    """Like :func:`check_timer`, with what was looked at."""
    inspection = Inspection(INSTEAD)
    inspection.apply(RULES, Timing(timer))
    return inspection.report
