"""Programs as one table: a row for each point of a trajectory, and a row for each thing that the gripper does."""

from __future__ import annotations

import csv
import io
import re
from collections.abc import Iterator, Sequence
from itertools import groupby
from math import isfinite

from llm3.errors import InputError
from llm3.export.curves import accelerations, check_accelerations
from llm3.export.program import Deed, Move, Program
from llm3.types import Event, EventKind, Pose, Trajectory

ABOUT = ("item", "kind", "action", "text", "segment", "time")
GRASP = ("grasp_x", "grasp_y", "grasp_z", "grasp_qx", "grasp_qy", "grasp_qz", "grasp_qw")
EVENT = ("opening", "object", *GRASP)
POINT = "point"
_POSITION = re.compile(r"(.+) position \[([^\[\]]+)\]")


def write_csv(program: Program) -> bytes:
    """The table as UTF-8 text. Numbers are written so that they read as the same numbers."""
    text = io.StringIO()
    table = csv.writer(text, lineterminator="\n")
    table.writerow([*ABOUT, *_columns(program.joints, program.units), *EVENT])
    for number, item in enumerate(program.items):
        table.writerows(_rows(number, item, 3 * len(program.joints)))
    return text.getvalue().encode()


def read_csv(content: bytes, source: str) -> Program:
    """Read what was written. Columns may stand in any order.

    Args:
        content: The file's bytes.
        source: Its name, for messages.

    Raises:
        InputError: It does not have the documented form.
    """
    try:
        lines = list(csv.reader(io.StringIO(content.decode("utf-8-sig"), newline=""), strict=True))
        head, rows = lines[0] if lines else [], [row for row in lines[1:] if row]
        joints, units = _joints(head)
        for number, row in enumerate(rows, start=1):
            if len(row) != len(head):
                raise ValueError(f"row {number} has {len(row)} cells, and the header has {len(head)}")
        cells = [dict(zip(head, row, strict=True)) for row in rows]
        return Program(joints, units, tuple(_items(cells, joints, units)))
    except UnicodeDecodeError as error:
        raise InputError(f"{source}: not UTF-8 text: {error.reason} at byte {error.start}") from error
    except (ValueError, csv.Error) as error:
        raise InputError(f"{source}: {error}") from error


def _columns(joints: Sequence[str], units: Sequence[str]) -> list[str]:
    """The headings of what a point has: positions, velocities, accelerations, by joint in each."""
    return [
        f"{joint} {quantity} [{unit}{per}]"
        for quantity, per in (("position", ""), ("velocity", "/s"), ("acceleration", "/s^2"))
        for joint, unit in zip(joints, units, strict=True)
    ]


def _rows(number: int, item: Deed | Move, width: int) -> Iterator[list[object]]:
    if isinstance(item, Move):
        trajectory = item.trajectory
        about = [number, POINT, item.action, item.text, item.segment]
        told = accelerations(trajectory).tolist()
        for time, q, v, a in zip(trajectory.times, trajectory.positions, trajectory.velocities, told, strict=True):
            yield [*about, time, *q, *v, *a, *[""] * len(EVENT)]
        return
    event = item.event
    grasp = (*event.grasp.position, *event.grasp.orientation) if event.grasp else [""] * len(GRASP)
    about = [number, event.kind.value, item.action, item.text, "", "", *[""] * width]
    yield [*about, "" if event.opening is None else event.opening, event.object or "", *grasp]


def _joints(head: Sequence[str]) -> tuple[tuple[str, ...], tuple[str, ...]]:
    """The names and units of the joints, by the heading of the columns."""
    found = [match.groups() for match in map(_POSITION.fullmatch, head) if match]
    joints, units = tuple(name for name, _ in found), tuple(unit for _, unit in found)
    wanted = [*ABOUT, *_columns(joints, units), *EVENT]
    for name in wanted:
        if head.count(name) != 1:
            raise ValueError(f"there must be one column {name!r}, and there are {head.count(name)}")
    for name in head:
        if name not in wanted:
            raise ValueError(f"unknown column {name!r}, expected {', '.join(wanted)}")
    return joints, units


def _items(cells: list[dict[str, str]], joints: Sequence[str], units: Sequence[str]) -> Iterator[Deed | Move]:
    names = _columns(joints, units)
    numbered = list(enumerate(cells, start=1))
    for _, group in groupby(numbered, key=lambda pair: pair[1]["item"]):
        rows = list(group)
        first, row = rows[0]
        about = [row[name] for name in ABOUT[:-1]]
        if any([other[name] for name in ABOUT[:-1]] != about for _, other in rows):
            raise ValueError(f"row {first} and those after it have one item, and differ in what they are about")
        action = _whole(row["action"], first)
        if row["kind"] == POINT:
            if any(other[name] for _, other in rows for name in EVENT):
                raise ValueError(f"row {first} or one after it is a point, and has what only events have")
            yield Move(action, row["text"], row["segment"], _trajectory(rows, names))
        elif len(rows) > 1 or any(row[name] for name in ("segment", "time", *names)):
            raise ValueError(f"row {first} is an event, and has what only points have, or stands for several")
        else:
            yield Deed(action, row["text"], _event(row, first))


def _trajectory(rows: list[tuple[int, dict[str, str]]], names: Sequence[str]) -> Trajectory:
    values = [[_number(row[name], number, name) for name in names] for number, row in rows]
    dof = len(names) // 3
    times = tuple(_number(row["time"], number, "time") for number, row in rows)
    positions, velocities, told = (
        tuple(tuple(row[begin : begin + dof]) for row in values) for begin in range(0, 3 * dof, dof)
    )
    trajectory = Trajectory(times, positions, velocities)
    check_accelerations(trajectory, told)
    return trajectory


def _event(row: dict[str, str], number: int) -> Event:
    kinds = [kind.value for kind in EventKind]
    if row["kind"] not in kinds:
        raise ValueError(f"row {number} is of kind {row['kind']!r}; valid: {', '.join([POINT, *kinds])}")
    grasp = None
    if any(row[name] for name in GRASP):
        x, y, z, *orientation = (_number(row[name], number, name) for name in GRASP)
        a, b, c, d = orientation
        grasp = Pose((x, y, z), (a, b, c, d))
    opening = _number(row["opening"], number, "opening") if row["opening"] else None
    return Event(EventKind(row["kind"]), opening, row["object"] or None, grasp)


def _number(text: str, row: int, column: str) -> float:
    try:
        value = float(text)
    except ValueError:
        value = float("nan")
    if not isfinite(value):
        raise ValueError(f"row {row} has {text!r} in the column {column!r}, and should have a number")
    return value


def _whole(text: str, row: int) -> int:
    if not (text.isascii() and text.isdigit() and len(text) <= 10):
        raise ValueError(f"row {row} has {text!r} in the column 'action', and should have a whole number")
    return int(text)
