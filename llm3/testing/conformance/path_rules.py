"""Rules for the paths that a motion planner finds."""

from __future__ import annotations

from collections.abc import Iterator
from itertools import pairwise

import numpy as np

from llm3.testing.conformance.inspection import Fault
from llm3.testing.conformance.plane import Case
from llm3.testing.conformance.planning import Planning
from llm3.testing.conformance.values import configuration
from llm3.types import Failure, Path, Vector

FINER = 4
NEAR = 1e-3
"""What is too little to matter, in steps of the resolution."""


def answers_are_paths_or_failures(planning: Planning) -> Iterator[Fault]:
    """Plan answers a Path of shape (N, dof), finite, or a Failure."""
    for answer in planning.answers():
        found, case = answer.found, answer.case
        if not isinstance(found, Path | Failure):
            yield Fault(f"{case.name}: plan answers {found!r}.", "It answers a Path or a Failure, and never None.")
        elif isinstance(found, Path):
            shape = np.asarray(found.waypoints).shape
            if len(shape) != 2 or shape[1] != case.dof or not shape[0] or not np.isfinite(found.waypoints).all():
                yield Fault(
                    f"{case.name}: the waypoints have shape {shape}, and a configuration has {case.dof} values.",
                    "Waypoints are a finite array of shape (N, dof), one configuration a row.",
                )


def paths_lead_from_the_start_to_their_goal(planning: Planning) -> Iterator[Fault]:
    """A path begins at the start, and ends at the goal that goal_index says."""
    for case, path, waypoints in planning.paths():
        if not np.allclose(waypoints[0], case.start, rtol=0, atol=1e-9):
            yield Fault(
                f"{case.name}: the path begins at {configuration(waypoints[0])}, and the start is "
                f"{configuration(case.start)}.",
                "The start itself is the first waypoint.",
            )
        if not 0 <= path.goal_index < len(case.goals):
            text = f"{case.name}: goal_index is {path.goal_index}, and there are {len(case.goals)} goals."
            yield Fault(text, "It is the place of the goal in problem.goals, from 0.")
        elif not np.allclose(waypoints[-1], case.goals[path.goal_index], rtol=0, atol=1e-9):
            yield Fault(
                f"{case.name}: the path ends at {configuration(waypoints[-1])}, and goal {path.goal_index} is "
                f"{configuration(case.goals[path.goal_index])}.",
                "The goal itself is the last waypoint, and goal_index says which one; goals in collision count, too.",
            )


def paths_stay_within_the_limits(planning: Planning) -> Iterator[Fault]:
    """No waypoint is outside of the limits."""
    for case, _, waypoints in planning.paths():
        low, high = np.array(case.low), np.array(case.high)
        outside = ((waypoints < low - 1e-9) | (waypoints > high + 1e-9)).any(axis=1)
        if outside.any():
            yield Fault(
                f"{case.name}: the path goes through {configuration(waypoints[outside][0])}, outside of "
                f"{configuration(low)} to {configuration(high)}.",
                "Samples, steering and smoothing must keep to problem.low and problem.high.",
            )


def paths_are_free(planning: Planning) -> Iterator[Fault]:
    """A path is free at the problem's resolution, and at four times finer steps but for half a step of a corner."""
    for case, _, waypoints in planning.paths():
        for factor, shrunk in ((1, 0.0), (FINER, 0.5)):
            line = _samples(case, waypoints, factor)
            blocked = ~case.free(line, shrunk)
            if blocked.any():
                yield Fault(
                    f"{case.name}: the path goes through {configuration(line[blocked][0])}, which is not free.",
                    "Every edge must be tested at the resolution, those of shortcuts and to the goal included: "
                    "neighbouring samples differ by Δq with Σ|Δq_j|/resolution_j ≤ 1.",
                )
                break


def every_edge_is_tested(planning: Planning) -> Iterator[Fault]:
    """Two neighbouring tests along a path are a step of the resolution apart at most, where nothing is known before."""
    questions = {answer.case.name: answer.questions for answer in planning.answers()}
    for case, _, waypoints in planning.paths():
        batches = questions[case.name].batches
        if case.tells_uncertain:
            continue
        tested = np.vstack([waypoints[:0], *batches]) / case.resolution
        for a, b in pairwise(waypoints / case.resolution):
            places = np.array([0.0, *_along(tested, a, b), 1.0])
            gaps = np.diff(places) * np.abs(b - a).sum()
            if gaps.max() > 1 + NEAR:
                i = int(gaps.argmax())
                ends = [configuration((a + places[k] * (b - a)) * case.resolution) for k in (i, i + 1)]
                yield Fault(
                    f"{case.name}: nothing is tested between {ends[0]} and {ends[1]} of the path, which are "
                    f"{gaps[i]:.3g} steps of the resolution apart.",
                    "An edge has at least Σ|Δq_j|/resolution_j steps, each joint with its own resolution; the sum, and "
                    "not the Euclidean length. FreeSpace.path tests so.",
                )
                return


def _along(points: Vector, a: Vector, b: Vector) -> Vector:
    """How far along the line from `a` to `b`, of 1, the points (N, dof) are that lie on it, in order."""
    edge = b - a
    if not edge.any():
        return np.empty(0)
    share = ((points - a) @ edge / (edge @ edge)).clip(0.0, 1.0)
    near = np.abs(a + share[:, None] * edge - points).sum(axis=1) < NEAR
    return np.sort(share[near])


def _samples(case: Case, waypoints: Vector, factor: float) -> Vector:
    """Points on the lines between the waypoints, so many of which come to a step of the resolution."""
    steps = factor * np.abs(np.diff(waypoints, axis=0) / case.resolution).sum(axis=1)
    lines = [
        np.linspace(a, b, 1 + max(1, int(np.ceil(n - 1e-9))))
        for (a, b), n in zip(pairwise(waypoints), steps, strict=True)
    ]
    return np.vstack([waypoints[:1], *lines])


RULES = (
    answers_are_paths_or_failures,
    paths_lead_from_the_start_to_their_goal,
    paths_stay_within_the_limits,
    paths_are_free,
    every_edge_is_tested,
)
