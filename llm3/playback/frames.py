"""Plays motions: from a state and what the robot does to what is where at every moment."""

from __future__ import annotations

from collections.abc import Iterable, Iterator
from dataclasses import dataclass, replace

import numpy as np

from llm3.types import EventKind, Held, Moment, PlannedAction, Pose, Segment, State, Timed, moment_of

STANDSTILL = 0.4
"""Seconds for which the robot stands still at an event, as plans do not tell how long a gripper takes."""


@dataclass(frozen=True)
class Frame:
    """A moment, and which action of the plan it belongs to."""

    moment: Moment
    action: int
    """Its place in the plan, from 0."""


def frames(start: State, steps: Iterable[PlannedAction], rate: float) -> Iterator[Frame]:
    """What is where at the start, at even times while the robot moves, at every event and at the end of every action.

    Where the plan has trajectories they are followed. Where it has none, the fastest joint moves at `llm3.types.PACE`.

    Args:
        start: The state in which the first action begins.
        steps: The actions.
        rate: How many frames a second.
    """
    last = moment_of(start)
    yield Frame(last, 0)
    for index, step in enumerate(steps):
        for moment in played(last, step, rate):
            yield Frame(moment, index)
            last = moment


def played(before: Moment, step: PlannedAction, rate: float) -> Iterator[Moment]:
    """The moments of one action, the last of which is the state that it leads to."""
    moment = before
    for segment in step.motion.segments:
        for event in segment.events:
            moment = replace(moment, time=moment.time + STANDSTILL, label=segment.label)
            if event.kind is EventKind.GRIPPER and event.opening is not None:
                moment = replace(moment, opening=event.opening)
            elif event.kind is EventKind.ATTACH and event.object and event.grasp:
                moment = _attached(moment, event.object, event.grasp)
            elif event.kind is EventKind.DETACH and event.object:
                moment = _detached(moment, event.object, step.state)
            yield moment
        began = moment.time
        for time, configuration in _positions(segment, rate):
            moment = replace(moment, configuration=configuration, time=began + time, label=segment.label)
            yield moment
    yield moment_of(step.state, moment.opening, moment.time)


def _attached(moment: Moment, name: str, grasp: Pose) -> Moment:
    poses = {other: pose for other, pose in moment.poses.items() if other != name}
    return replace(moment, poses=poses, held=Held(name, grasp))


def _detached(moment: Moment, name: str, after: State) -> Moment:
    """Let go: what is let go is shown where it comes to rest, which is no farther than it falls."""
    poses = {**moment.poses, name: after.poses[name]} if name in after.poses else moment.poses
    return replace(moment, poses=poses, held=None)


def evenly(frames: Iterable[Frame], rate: float) -> Iterator[Frame]:
    """One frame at each even time, and the last one: what a film needs, in which nothing happens in between.

    Args:
        frames: In order of their times.
        rate: How many frames a second.
    """
    last, count = None, 0
    for frame in frames:
        while last and count / rate < frame.moment.time:
            yield last
            count += 1
        last = frame
    if last:
        yield last


def _positions(segment: Segment, rate: float) -> Iterator[tuple[float, tuple[float, ...]]]:
    """Times since the segment began, in seconds, and where the robot is then."""
    timed = Timed(segment)
    times = np.linspace(0.0, timed.duration, max(1, round(timed.duration * rate)) + 1)[1:]
    yield from zip(times.tolist(), map(tuple, timed.positions(times).tolist()), strict=True)
