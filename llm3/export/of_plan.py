"""From a plan to a program, and back."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import replace

from llm3.errors import InputError
from llm3.export.program import Deed, Move, Program
from llm3.records import PlanFile
from llm3.types import Event, Motion, Segment, Trajectory


def program_of(plan: PlanFile) -> Program:
    """What a robot does for a plan.

    Whether it is within the limits is another question; see :func:`llm3.export.check_program`.

    Raises:
        InputError: The plan has no times or no joints, or something in it has no place in a program.
    """
    if not plan.joints:
        raise InputError(
            f"the plan names no joints, so there is nothing to hand over: domain {plan.domain!r} has none."
        )
    try:
        names, units = zip(*((joint.name, joint.unit) for joint in plan.joints), strict=True)
        return Program(names, units, tuple(_items(plan)))
    except ValueError as error:
        raise InputError(f"the plan cannot be handed over: {error}") from error


def plan_with(plan: PlanFile, program: Program) -> PlanFile:
    """The plan with the motions of a program in place of its own; everything else is the plan's.

    The waypoints of a segment are then the points of its trajectory.

    Raises:
        InputError: The program is not for these joints or these actions.
    """
    order = _order(plan, program)
    actions = [(number, str(step.action)) for number, step in enumerate(plan.actions, start=1)]
    for item in program.items:
        if (item.action, item.text) not in actions:
            there = actions[item.action - 1][1] if item.action <= len(actions) else f"only {len(actions)} actions"
            raise InputError(f"the trajectories have action {item.action} {item.text}, and the plan has {there}.")
    return replace(
        plan,
        actions=tuple(
            replace(step, motion=_motion([item for item in program.items if item.action == number], order))
            for number, step in enumerate(plan.actions, start=1)
        ),
    )


def _items(plan: PlanFile) -> Iterator[Deed | Move]:
    for number, step in enumerate(plan.actions, start=1):
        text = str(step.action)
        for segment in step.motion.segments:
            for event in segment.events:
                yield Deed(number, text, event)
            if segment.trajectory is None:
                raise InputError(
                    f"action {number} {text}, {segment.label}: the plan has no times. Install them with "
                    "pip install 'llm3[time]', and run again without --timing none."
                )
            yield Move(number, text, segment.label, segment.trajectory)


def _order(plan: PlanFile, program: Program) -> tuple[int, ...]:
    """Where in the program's joint values each of the plan's stands."""
    wanted = {joint.name: joint.unit for joint in plan.joints}
    found = dict(zip(program.joints, program.units, strict=True))
    if wanted != found:
        planned, there = (
            ", ".join(f"{name} ({unit})" for name, unit in side.items()) or "none" for side in (wanted, found)
        )
        raise InputError(f"the plan is for a robot with the joints {planned}, and the trajectories are for {there}.")
    return tuple(program.joints.index(joint.name) for joint in plan.joints)


def _motion(items: list[Deed | Move], order: tuple[int, ...]) -> Motion:
    segments, events = [], list[Event]()
    for item in items:
        if isinstance(item, Deed):
            events.append(item.event)
            continue
        trajectory = Trajectory(
            item.trajectory.times,
            tuple(tuple(row[joint] for joint in order) for row in item.trajectory.positions),
            tuple(tuple(row[joint] for joint in order) for row in item.trajectory.velocities),
        )
        segments.append(Segment(item.segment, trajectory.positions, tuple(events), trajectory))
        events = []
    if events:
        last = items[-1]
        raise InputError(
            f"action {last.action} {last.text}: no motion follows its last event, {events[-1].kind.value}."
        )
    return Motion(tuple(segments))
