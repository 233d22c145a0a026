"""A plan so simple that all figures are known: the toy arm takes a box on a shelf, slides along, and lets it go.

The arm stands upright and only its slide moves, along x. The box stands on the shelf between the fingers, the hand is
below the shelf.
"""

from __future__ import annotations

from dataclasses import replace

from llm3.types import (
    Action,
    Event,
    EventKind,
    Held,
    Motion,
    PlannedAction,
    Pose,
    Segment,
    State,
    Verification,
)
from llm3_bullet.clients import connect
from llm3_bullet.robot import RobotDescription
from llm3_bullet.scene import Box
from llm3_bullet.verification import PlainWorld, Playback

TIP = (0.0, 0.1, 1.09)
"""Where the tool is when the slide is at 0."""
SHELF = Box("shelf", (0.6, 0.02, 0.008), Pose((0.2, 0.1, 1.066)), fixed=True)
SIZE = (0.04, 0.03, 0.04)
WIDE, WIDTH = 0.08, 0.03
"""The gripper's widest opening and the box's width, in metres."""
CARRIED, END = 0.03, 0.1
"""Where the slide is when the box is let go, and at the end, in metres."""
GRASP = Pose((0.0, 0.0, 0.0))


def at(slide: float) -> tuple[float, ...]:
    """The configuration with the slide there."""
    return (slide, 0.0, 0.0)


def box_at(x: float, z: float = 0.0) -> Pose:
    """The box on the shelf, or `z` above it."""
    return Pose((x, TIP[1], TIP[2] + z))


def gripper(opening: float) -> Event:
    return Event(EventKind.GRIPPER, opening=opening)


ATTACH = Event(EventKind.ATTACH, object="box", grasp=GRASP)
DETACH = Event(EventKind.DETACH, object="box")
START = State({"box": box_at(0.0)}, at(0.0))
CARRY = Segment("carry", (at(0.0), at(CARRIED)), (gripper(WIDTH), ATTACH))
LEAVE = Segment("leave", (at(CARRIED), at(END)), (DETACH, gripper(WIDE)))
TAKE = PlannedAction(Action("take"), Motion((CARRY,)), State({}, at(CARRIED), Held("box", GRASP)))
DROP = PlannedAction(Action("drop"), Motion((LEAVE,)), State({"box": box_at(CARRIED)}, at(END)))
PLAN = (TAKE, DROP)
TAKEN, DROPPED = "action 1 take([], {})", "action 2 drop([], {})"
CARRYING, LEAVING = f"{TAKEN}, carry", f"{DROPPED}, leave"
"""How the lines of defects begin."""


def moved_by(step: PlannedAction, segment: Segment, state: State | None = None) -> PlannedAction:
    """The action with another motion and, where given, another state after it."""
    return replace(step, motion=Motion((segment,)), state=state or step.state)


def verification(
    robot: RobotDescription,
    plan: tuple[PlannedAction, ...] = PLAN,
    start: State = START,
    fixed: tuple[Box, ...] = (SHELF,),
) -> Verification:
    """What a second look finds."""
    boxes = [Box(name, SIZE, pose) for name, pose in start.poses.items()]
    with connect() as client:
        playback = Playback(PlainWorld(client, robot, fixed, boxes), start)
        for step in plan:
            playback.play(step)
        return playback.findings.report()


def lines(robot: RobotDescription, *arguments: object, **keywords: object) -> list[str]:
    """The lines that are told of its defects."""
    return [str(defect) for defect in verification(robot, *arguments, **keywords).defects]  # type: ignore[arg-type]  # as there


def found(robot: RobotDescription, step: PlannedAction) -> list[str]:
    """The lines that are told of the plan with this one instead of its first or its second action."""
    return lines(robot, (step, DROP) if step.action == TAKE.action else (TAKE, step))
