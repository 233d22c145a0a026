"""Whether a robot can do what a program says, as far as its joints are concerned."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from math import inf

import numpy as np

from llm3.errors import LLM3Error
from llm3.export.curves import Array, Curves, cubics, extreme, largest, quintics
from llm3.export.program import Move, Program
from llm3.interfaces import Joint
from llm3.types import Defect, Trajectory

OVER = 1e-6
"""By so much a limit may be exceeded, in its unit: rounding."""
SAME = 0.00021
"""How far from the end of one motion the next may begin, in the joint's unit: states are rounded to 0.0001."""
STILL = 1e-6
"""What is slower stands still, in the joint's unit per second."""


@dataclass(frozen=True, eq=False)
class Limits:
    """What joints can do, by joint, (dof,); infinite where that is not known."""

    middle: Array
    """Of the travel; 0 where its ends are not known."""
    reach: Array
    """How far they get from the middle either way."""
    velocity: Array
    acceleration: Array

    @classmethod
    def of(cls, joints: Sequence[Joint]) -> Limits:
        """The limits of these joints."""
        ends = [(j.min_position, j.max_position) for j in joints]
        return cls(
            np.array([0.0 if a is None or b is None else a / 2 + b / 2 for a, b in ends]),
            np.array([inf if a is None or b is None else b / 2 - a / 2 for a, b in ends]),
            np.array([inf if j.max_velocity is None else j.max_velocity for j in joints]),
            np.array([inf if j.max_acceleration is None else j.max_acceleration for j in joints]),
        )

    def kinds(self, curves: Curves) -> Iterator[tuple[str, Array, Array]]:
        """What is limited: coefficients (k, pieces, dof), of positions from the middle, and what is allowed, (dof,)."""
        positions, velocities, accelerations = curves.derivatives
        centred = positions.copy()
        centred[0] -= self.middle
        yield "position", centred, self.reach
        yield "velocity", velocities, self.velocity
        yield "acceleration", accelerations, self.acceleration

    def keep(self, trajectory: Trajectory) -> bool:
        """Whether they hold at all times, with and without the accelerations."""
        return len(trajectory.times) == 1 or all(
            (largest(coefficients, allowed) <= allowed + OVER).all()
            for curves in (cubics(trajectory), quintics(trajectory))
            for _, coefficients, allowed in self.kinds(curves)
        )


def check_program(program: Program, joints: Sequence[Joint], start: Sequence[float], quintic: bool = False) -> None:
    """See that a robot can follow a program: within its limits at all times, and without a jump.

    Args:
        program: What is to be done.
        joints: What the robot can do, in the order of the program's joints. A limit that is None is not looked at.
        start: Where the robot is before it, in the order of the joints.
        quintic: Whether a reader gets the accelerations, too, and follows quintics: then these are looked at as well.

    Raises:
        LLM3Error: It cannot. One line that names the action, the segment, the joint, the value and the limit.
    """
    limits, at = Limits.of(joints), np.array(start, dtype=float)
    with np.errstate(all="ignore"):  # a broken plan may hold any number
        for move in (item for item in program.items if isinstance(item, Move)):
            _check_ends(move, joints, at)
            at = np.array(move.trajectory.positions[-1])
            if len(move.trajectory.times) > 1:
                _check_limits(move, cubics(move.trajectory), joints, limits, "")
                if quintic:
                    _check_limits(move, quintics(move.trajectory), joints, limits, " where accelerations are followed")


def _check_ends(move: Move, joints: Sequence[Joint], at: Array) -> None:
    trajectory = move.trajectory
    jumps = np.abs(np.array(trajectory.positions[0]) - at)
    joint = int(jumps.argmax())
    if not jumps[joint] <= SAME:
        name, unit = joints[joint].name, joints[joint].unit
        raise _refused(move, 0.0, f"{name} jumps by {_figure(jumps[joint])} {unit} from where the robot is")
    for end, verb in ((0, "begins"), (-1, "ends")):
        speeds = np.abs(trajectory.velocities[end])
        joint = int(speeds.argmax())
        if not speeds[joint] <= STILL:
            name, unit = joints[joint].name, joints[joint].unit
            sentence = f"the trajectory {verb} while {name} moves at {_figure(speeds[joint])} {unit}/s"
            raise _refused(move, trajectory.times[end], sentence)


def _check_limits(move: Move, curves: Curves, joints: Sequence[Joint], limits: Limits, how: str) -> None:
    for kind, coefficients, allowed in limits.kinds(curves):
        peaks = largest(coefficients, allowed)
        beyond = np.where(np.isfinite(allowed), peaks - allowed, -inf)  # what overflows is beyond what is known
        if (beyond <= OVER).all():
            continue
        piece, index = map(int, np.unravel_index(int(beyond.argmax()), beyond.shape))
        joint, limit, begin = joints[index], float(allowed[index]), move.trajectory.times[piece]
        u, value = 0.0, inf
        if np.isfinite(peaks[piece, index]):
            u, value = extreme(coefficients[:, piece, index])
        time, unit, size = begin + u * (move.trajectory.times[piece + 1] - begin), joint.unit, _figure(abs(value))
        sentence = {
            "position": f"is at {_figure(value + float(limits.middle[index]))} {unit}{how}, and its limits are "
            f"{joint.min_position} and {joint.max_position} {unit}",
            "velocity": f"moves at {size} {unit}/s{how}, and its limit is {limit:.4f} {unit}/s",
            "acceleration": f"accelerates by {size} {unit}/s²{how}, and its limit is {limit:.4f} {unit}/s²",
        }[kind]
        raise _refused(move, time, f"{joint.name} {sentence}")


def _figure(value: float) -> str:
    return f"{value:.4f}" if abs(value) < 1e6 else f"{value:.4g}"


def _refused(move: Move, time: float, sentence: str) -> LLM3Error:
    return LLM3Error(f"{Defect(sentence, move.action, move.text, move.segment, time=time)}.")
