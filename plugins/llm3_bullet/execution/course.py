"""Where the arm is meant to be at each time step of a plan; a plan that makes no sense for it is refused."""

from __future__ import annotations

from collections.abc import Iterable, Iterator
from math import ceil

import numpy as np

from llm3.errors import InputError
from llm3.types import Event, EventKind, PlannedAction, Timed
from llm3_bullet.model import RobotModel
from llm3_bullet.poses import Array

LONGEST = 3600.0
"""Motions that take longer than this together, in seconds, are a mistake."""
SLACK = 0.001
"""How far outside of its limits a joint may be sent, in radians or metres: rounding, and cubics between knots."""


def course(model: RobotModel, actions: Iterable[PlannedAction], time_step: float) -> list[list[Array]]:
    """The configurations at the end of each time step.

    Args:
        model: The robot.
        actions: The plan.
        time_step: In seconds.

    Returns:
        For each action, for each of its segments, (N, dof), at least one.

    Raises:
        InputError: The motions take very long, or leave the limits of the joints.
    """
    actions = tuple(actions)
    pieces = [[Timed(segment) for segment in step.motion.segments] for step in actions]
    with np.errstate(over="ignore", invalid="ignore"):  # a broken plan may hold any number
        seconds = sum(piece.duration for of_action in pieces for piece in of_action)
    if not seconds <= LONGEST:
        raise InputError(f"the motions of the plan take {seconds:g} s, and at most {LONGEST:g} s are carried out.")
    sampled = [[_sampled(piece, time_step) for piece in of_action] for of_action in pieces]
    for number, (step, of_action) in enumerate(zip(actions, sampled, strict=True), start=1):
        for segment, configurations in zip(step.motion.segments, of_action, strict=True):
            flaw = next(_beyond(model, configurations), None)
            if flaw:
                raise InputError(f"action {number} {step.action}, {segment.label}: {flaw}.")
    return sampled


def check_events(model: RobotModel, names: Iterable[str], actions: Iterable[PlannedAction]) -> None:
    """See that all events make sense.

    Args:
        model: The robot.
        names: What it can take.
        actions: The plan.

    Raises:
        InputError: One does not.
    """
    known = tuple(names)
    for number, step in enumerate(actions, start=1):
        for event in step.motion.events:
            flaw = _flaw(event, model.description.gripper.max_opening, known)
            if flaw:
                raise InputError(f"action {number} {step.action}: {flaw}.")


def _sampled(piece: Timed, time_step: float) -> Array:
    count = max(1, ceil(piece.duration / time_step))
    with np.errstate(over="ignore", invalid="ignore"):  # as above; `_beyond` tells
        return piece.positions(np.linspace(0.0, piece.duration, count + 1)[1:])


def _beyond(model: RobotModel, configurations: Array) -> Iterator[str]:
    inside = (configurations >= model.low - SLACK) & (configurations <= model.high + SLACK)
    for row, joint in np.argwhere(~inside)[:1].tolist():
        name, low, high = model.description.arm_joints[joint], model.low[joint], model.high[joint]
        yield f"{name} is to go to {configurations[row, joint]:.6g}, and its limits are {low:.6g} to {high:.6g}"


def _flaw(event: Event, widest: float, names: tuple[str, ...]) -> str:
    """What is wrong with an event; empty if nothing is."""
    kind = f"an event of the kind '{event.kind.value}'"
    if event.kind is EventKind.GRIPPER:
        if event.opening is None:
            return f"{kind} lacks its opening"
        if not 0 <= event.opening <= widest:
            return f"the gripper is to open to {event.opening:g} m, and its range is 0 to {widest:g} m"
    elif event.object is None:
        return f"{kind} lacks its object"
    elif event.object not in names:
        return f"{kind} names {event.object!r}, and there is no such thing; there are {', '.join(names)}"
    elif event.kind is EventKind.ATTACH and event.grasp is None:
        return f"{kind} lacks its grasp"
    return ""
