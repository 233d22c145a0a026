"""Programs as numpy arrays in a zip archive, without pickle."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from typing import Any

import numpy as np
from numpy.typing import NDArray

from llm3.errors import InputError
from llm3.export.archive import packed, read_arrays
from llm3.export.curves import accelerations, check_accelerations
from llm3.export.program import Deed, Move, Program
from llm3.types import Event, EventKind, Pose, Trajectory

MOVE = "trajectory"
POINTS = ("point_position", "point_velocity", "point_acceleration")
TEXT, WHOLE, NUMBER = "U", "i", "f"
ARRAYS: tuple[tuple[str, str, int], ...] = (
    ("joint_names", TEXT, 1),
    ("joint_units", TEXT, 1),
    ("item_kind", TEXT, 1),
    ("item_action", WHOLE, 1),
    ("item_text", TEXT, 1),
    ("item_segment", TEXT, 1),
    ("item_opening", NUMBER, 1),
    ("item_object", TEXT, 1),
    ("item_grasp", NUMBER, 2),
    ("item_points", WHOLE, 1),
    ("point_time", NUMBER, 1),
    *((name, NUMBER, 2) for name in POINTS),
)
"""The name, the kind of dtype and the number of dimensions of each array."""


def write_npz(program: Program) -> bytes:
    """The archive, compressed."""
    items, dof = program.items, len(program.joints)
    moves = [item.trajectory if isinstance(item, Move) else None for item in items]
    events = [item.event if isinstance(item, Deed) else None for item in items]
    counts = [len(trajectory.times) if trajectory else 0 for trajectory in moves]
    there = [trajectory for trajectory in moves if trajectory]
    grasps = [(*e.grasp.position, *e.grasp.orientation) if e and e.grasp else (np.nan,) * 7 for e in events]
    arrays: dict[str, NDArray[Any]] = {
        "joint_names": np.array(program.joints),
        "joint_units": np.array(program.units),
        "item_kind": np.array([e.kind.value if e else MOVE for e in events], dtype=str),
        "item_action": np.array([item.action for item in items], dtype=np.int64),
        "item_text": np.array([item.text for item in items], dtype=str),
        "item_segment": np.array([item.segment if isinstance(item, Move) else "" for item in items], dtype=str),
        "item_opening": np.array(
            [np.nan if e is None or e.opening is None else e.opening for e in events], dtype=float
        ),
        "item_object": np.array([e.object if e and e.object else "" for e in events], dtype=str),
        "item_grasp": np.array(grasps, dtype=float).reshape(-1, 7),
        "item_points": np.cumsum([0, *counts], dtype=np.int64),
        "point_time": np.array([time for t in there for time in t.times], dtype=float),
        "point_position": np.array([row for t in there for row in t.positions], dtype=float).reshape(-1, dof),
        "point_velocity": np.array([row for t in there for row in t.velocities], dtype=float).reshape(-1, dof),
        "point_acceleration": np.concatenate([np.empty((0, dof)), *map(accelerations, there)]),
    }
    return packed(arrays)


def read_npz(content: bytes, source: str) -> Program:
    """Read what was written. Nothing is unpickled, and no more memory is taken than the arrays need.

    Args:
        content: The file's bytes.
        source: Its name, for messages.

    Raises:
        InputError: It does not have the documented form.
    """
    try:
        arrays = read_arrays(content, [name for name, _, _ in ARRAYS])
        _check(arrays)
        joints, units = (tuple(arrays[name].tolist()) for name in ("joint_names", "joint_units"))
        return Program(joints, units, tuple(_items(arrays)))
    except ValueError as error:
        raise InputError(f"{source}: {error}") from error


def _check(arrays: Mapping[str, NDArray[Any]]) -> None:
    """See that the arrays fit one another."""
    for name, kind, dimensions in ARRAYS:
        array = arrays[name]
        if array.dtype.kind != kind or array.ndim != dimensions:
            raise ValueError(
                f"the array {name!r} has the dtype {array.dtype} and {array.ndim} dimensions, and should have a dtype "
                f"of kind {kind!r} and {dimensions}"
            )
    points, dof = arrays["item_points"], len(arrays["joint_names"])
    items = len(arrays["item_kind"])
    shapes: dict[str, tuple[int, ...]] = {name: (items,) for name, _, _ in ARRAYS if name.startswith("item_")}
    shapes |= {"item_grasp": (items, 7), "item_points": (items + 1,), "point_time": (len(arrays["point_time"]),)}
    shapes |= {name: (len(arrays["point_time"]), dof) for name in POINTS}
    for name, shape in shapes.items():
        if arrays[name].shape != shape:
            raise ValueError(f"the array {name!r} has the shape {arrays[name].shape}, and should have {shape}")
    if points[0] != 0 or points[-1] != len(arrays["point_time"]) or (points[1:] < points[:-1]).any():
        raise ValueError("the array 'item_points' must go from 0 to the number of points, and never back")


def _items(arrays: Mapping[str, NDArray[Any]]) -> Iterator[Deed | Move]:
    names = ("kind", "action", "text", "segment", "opening", "object", "grasp")
    columns = [arrays[f"item_{name}"].tolist() for name in names]
    points = arrays["item_points"].tolist()
    for number, (kind, action, text, segment, opening, name, grasp) in enumerate(zip(*columns, strict=True)):
        begin, end = points[number], points[number + 1]
        if kind == MOVE:
            if name or not np.isnan([opening, *grasp]).all():
                raise ValueError(f"item {number} is a trajectory, and has what only events have")
            yield Move(action, text, segment, _trajectory(arrays, begin, end))
        elif segment or end > begin:
            raise ValueError(f"item {number} is an event, and has what only trajectories have")
        else:
            yield Deed(action, text, _event(kind, opening, name, grasp))


def _trajectory(arrays: Mapping[str, NDArray[Any]], begin: int, end: int) -> Trajectory:
    times = tuple(arrays["point_time"][begin:end].tolist())
    positions, velocities, told = (tuple(map(tuple, arrays[name][begin:end].tolist())) for name in POINTS)
    trajectory = Trajectory(times, positions, velocities)
    check_accelerations(trajectory, told)
    return trajectory


def _event(kind: str, opening: float, name: str, grasp: list[float]) -> Event:
    if kind not in {known.value for known in EventKind}:
        valid = ", ".join([MOVE, *(known.value for known in EventKind)])
        raise ValueError(f"an item is of kind {kind!r}; valid: {valid}")
    pose = None
    if not np.isnan(grasp).all():
        x, y, z, *orientation = grasp
        a, b, c, d = orientation
        pose = Pose((x, y, z), (a, b, c, d))
    return Event(EventKind(kind), None if np.isnan(opening) else opening, name or None, pose)
