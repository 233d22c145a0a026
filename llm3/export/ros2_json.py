"""Programs as JSON whose parts are spelled as messages of ROS 2.

Trajectories are ``trajectory_msgs/msg/JointTrajectory``; what the gripper does is the goal of a
``control_msgs/action/GripperCommand``.
"""

from __future__ import annotations

import json
from collections.abc import Mapping
from dataclasses import dataclass
from typing import Any, Literal

from llm3.errors import InputError
from llm3.export.curves import accelerations, check_accelerations
from llm3.export.program import Deed, Move, Program
from llm3.export.ros2_messages import (
    SECOND,
    Duration,
    Goal,
    GripperCommand,
    Header,
    JointTrajectory,
    JointTrajectoryPoint,
)
from llm3.jsonio import loads, to_builtins
from llm3.types import Event, EventKind, Pose, Trajectory

FORMAT = "llm3-program/1"


@dataclass(frozen=True)
class Item:
    """A line of the file."""

    kind: Literal["trajectory", "gripper", "attach", "detach"]
    action: int
    text: str
    segment: str | None = None
    trajectory: JointTrajectory | None = None
    goal: Goal | None = None
    object: str | None = None
    grasp: Pose | None = None


@dataclass(frozen=True)
class File:
    """The file."""

    format: str
    joint_names: tuple[str, ...]
    joint_units: tuple[str, ...]
    items: tuple[Item, ...]

    def __post_init__(self) -> None:
        if self.format != FORMAT:
            raise ValueError(f"the format is {self.format!r}, and this version reads {FORMAT!r}")


def write_ros2_json(program: Program, with_accelerations: bool = False) -> bytes:
    """The text of a file, an item a line.

    Args:
        program: What is to be done; its times are rounded to nanoseconds.
        with_accelerations: Whether messages tell accelerations. A controller that gets them follows quintics.
    """
    head = {"format": FORMAT, "joint_names": program.joints, "joint_units": program.units}
    fields = "".join(f"{_line(name)}: {_line(value)},\n" for name, value in head.items())
    items = ",\n".join(_line(_written(item, program, with_accelerations)) for item in program.items)
    return f'{{\n{fields}"items": [\n{items}\n]\n}}\n'.encode()


def read_ros2_json(content: bytes, source: str) -> Program:
    """Read what was written. Joints may stand in another order in each trajectory.

    Args:
        content: The file's bytes.
        source: Its name, for messages.

    Raises:
        InputError: It does not have the documented form.
    """
    file = loads(content, File, source)
    try:
        items = tuple(_read(item, file.joint_names) for item in file.items)
        return Program(file.joint_names, file.joint_units, items)
    except ValueError as error:
        raise InputError(f"{source}: {error}") from error


def _line(value: Any) -> str:
    """JSON with the fields in their own order, as messages have them."""
    return json.dumps(to_builtins(value), ensure_ascii=False)


def _written(item: Deed | Move, program: Program, with_accelerations: bool) -> Mapping[str, Any]:
    if isinstance(item, Move):
        message = _message(item.trajectory, program.joints, with_accelerations)
        about = {"kind": "trajectory", "action": item.action, "text": item.text, "segment": item.segment}
        return {**about, "trajectory": message}
    event = item.event
    about = {"kind": event.kind.value, "action": item.action, "text": item.text}
    if event.kind is EventKind.GRIPPER:
        assert event.opening is not None  # noqa: S101  # a deed sees to it
        return {**about, "goal": Goal(GripperCommand(event.opening))}
    return {**about, "object": event.object} | ({"grasp": event.grasp} if event.grasp else {})


def _message(trajectory: Trajectory, joints: tuple[str, ...], with_accelerations: bool) -> JointTrajectory:
    told = accelerations(trajectory).tolist() if with_accelerations else [()] * len(trajectory.times)
    points = tuple(
        JointTrajectoryPoint(q, v, tuple(a), (), Duration(*divmod(round(time * SECOND), SECOND)))
        for time, q, v, a in zip(trajectory.times, trajectory.positions, trajectory.velocities, told, strict=True)
    )
    return JointTrajectory(Header(), joints, points)


def _read(item: Item, joints: tuple[str, ...]) -> Deed | Move:
    move, deed = (item.segment, item.trajectory), (item.goal, item.object, item.grasp)
    if item.kind == "trajectory":
        if None in move or deed != (None, None, None):
            raise ValueError(f"a trajectory of action {item.action} needs segment and trajectory, and nothing else")
        assert item.segment is not None and item.trajectory is not None  # noqa: S101, PT018  # for mypy
        return Move(item.action, item.text, item.segment, _trajectory(item.trajectory, joints))
    if move != (None, None):
        raise ValueError(f"a {item.kind} of action {item.action} has neither segment nor trajectory")
    opening = item.goal.command.position if item.goal else None
    return Deed(item.action, item.text, Event(EventKind(item.kind), opening, item.object, item.grasp))


def _trajectory(message: JointTrajectory, joints: tuple[str, ...]) -> Trajectory:
    """What a message tells, its values in this order of joints."""
    if sorted(message.joint_names) != sorted(joints):
        raise ValueError(
            f"a trajectory is for {', '.join(message.joint_names) or 'no joints'}, not {', '.join(joints)}"
        )
    order = [message.joint_names.index(name) for name in joints]

    def ordered(name: str) -> tuple[tuple[float, ...], ...]:
        rows = tuple(getattr(point, name) for point in message.points)
        if any(len(row) != len(order) for row in rows):
            raise ValueError(f"every point of a trajectory needs {len(order)} {name}")
        return tuple(tuple(row[joint] for joint in order) for row in rows)

    times = tuple((p.time_from_start.sec * SECOND + p.time_from_start.nanosec) / SECOND for p in message.points)
    trajectory = Trajectory(times, ordered("positions"), ordered("velocities"))
    if any(point.effort for point in message.points):
        raise ValueError("the effort of a trajectory's points must be empty: nothing here reads it")
    if any(point.accelerations for point in message.points):
        check_accelerations(trajectory, ordered("accelerations"))
    return trajectory
