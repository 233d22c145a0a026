"""Looks at a piece of motion in time: where it goes, how fast, and how hard it accelerates."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from llm3.types import Trajectory, Waypoints
from llm3_bullet.poses import Array
from llm3_bullet.verification.findings import Findings
from llm3_bullet.verification.sweep import cubic, sweep
from llm3_bullet.verification.world import PlainWorld

SAME = 1e-6
"""Radians or metres, and per second: joint values and speeds that differ by less are the same."""
OVER = 1e-6
"""By so much a limit may be exceeded, in its unit: floating point."""


def check_trajectory(
    world: PlainWorld, trajectory: Trajectory, waypoints: Waypoints, opening: float, findings: Findings
) -> None:
    """Tell what is wrong with a segment's trajectory, whose path need not be quite that of the waypoints.

    Args:
        world: Where the segment takes place.
        trajectory: The segment in time.
        waypoints: The segment's.
        opening: Distance between the fingers in metres.
        findings: Where to tell it.
    """
    _check_ends(world, trajectory, waypoints, findings)
    curves = _curves(trajectory)
    inside = _check_limits(world, curves, findings)
    velocities = np.array(trajectory.velocities)
    for index, (begin, span) in enumerate(zip(curves.begins, curves.spans, strict=True)) if inside else ():
        a, b = (np.append(trajectory.positions[i], opening) for i in (index, index + 1))
        derivatives = (np.append(velocities[i] * span, 0.0) for i in (index, index + 1))
        for u, look in sweep(world, cubic(a, b, *derivatives)):
            findings.see(look, time=begin + u * span)


def _check_ends(world: PlainWorld, trajectory: Trajectory, waypoints: Waypoints, findings: Findings) -> None:
    names, units = world.arm.joint_names, world.arm.units
    for verb, end in (("begins", 0), ("ends", -1)):
        position, velocity = np.array(trajectory.positions[end]), np.array(trajectory.velocities[end])
        time = trajectory.times[end]
        apart = np.abs(position - waypoints[end])
        joint = int(apart.argmax())
        if apart[joint] > SAME:
            findings.tell(
                f"the trajectory {verb} with {names[joint]} at {position[joint]:.4f} {units[joint]}, and the waypoints "
                f"at {waypoints[end][joint]:.4f} {units[joint]}",
                time=time,
            )
        joint = int(np.abs(velocity).argmax())
        if abs(velocity[joint]) > SAME:
            findings.tell(
                f"the trajectory {verb} while {names[joint]} moves at {velocity[joint]:.4f} {units[joint]}/s", time=time
            )


@dataclass(frozen=True, eq=False)
class _Curves:
    """The polynomials of a trajectory: q(u) = c0 + c1 u + c2 u² + c3 u³ for u from 0 to 1, each (pieces, dof)."""

    begins: Array
    """When each begins, (pieces,), in seconds."""
    spans: Array
    """How long each takes, (pieces,), in seconds."""
    coefficients: tuple[Array, Array, Array, Array]

    def positions(self, u: Array) -> Array:
        c0, c1, c2, c3 = self.coefficients
        return np.asarray(c0 + u * (c1 + u * (c2 + u * c3)))

    def speeds(self, u: Array) -> Array:
        _, c1, c2, c3 = self.coefficients
        return np.asarray(np.abs(c1 + u * (2 * c2 + 3 * u * c3)) / self.spans[:, None])

    def accelerations(self, u: Array) -> Array:
        _, _, c2, c3 = self.coefficients
        return np.asarray(np.abs(2 * c2 + 6 * u * c3) / self.spans[:, None] ** 2)

    def turning_points(self) -> tuple[Array, ...]:
        """Where positions and speeds may be extreme: the ends, and where the first or second derivative is 0."""
        _, c1, c2, c3 = self.coefficients
        with np.errstate(divide="ignore", invalid="ignore"):
            root = np.sqrt(c2 * c2 - 3 * c1 * c3)
            inner = ((-c2 + root) / (3 * c3), (-c2 - root) / (3 * c3), -c1 / (2 * c2), -c2 / (3 * c3))
        bounded = (np.clip(np.nan_to_num(u), 0.0, 1.0) for u in inner)
        return np.zeros_like(c1), np.ones_like(c1), *bounded


def _curves(trajectory: Trajectory) -> _Curves:
    times, q, v = (np.array(rows) for rows in (trajectory.times, trajectory.positions, trajectory.velocities))
    spans = np.diff(times)
    c0, c1, end = q[:-1], v[:-1] * spans[:, None], v[1:] * spans[:, None]
    way = q[1:] - c0
    return _Curves(times[:-1], spans, (c0, c1, 3 * way - 2 * c1 - end, c1 + end - 2 * way))


def _check_limits(world: PlainWorld, curves: _Curves, findings: Findings) -> bool:
    """Tell the worst excess of each kind; whether the joints stay where they can go at all."""
    arm = world.arm
    if not len(curves.spans):
        return True
    points = curves.turning_points()
    low, high = arm.limits.T
    inside = True
    positions, speeds, accelerations = (
        np.array([function(u) for u in points]) for function in (curves.positions, curves.speeds, curves.accelerations)
    )
    for kind, values, beyond in (
        ("position", positions, np.maximum(low - positions, positions - high)),
        ("speed", speeds, speeds - arm.max_velocity),
        ("acceleration", accelerations, accelerations - arm.max_acceleration),
    ):
        point, piece, joint = np.unravel_index(int(beyond.argmax()), beyond.shape)
        if beyond[point, piece, joint] <= OVER:
            continue
        inside &= kind != "position"
        name, unit, value = arm.joint_names[joint], arm.units[joint], values[point, piece, joint]
        velocity, acceleration = arm.max_velocity[joint], arm.max_acceleration[joint]
        sentence = {
            "position": f"is at {value:.4f} {unit}, and its limits are {low[joint]:.4f} and {high[joint]:.4f} {unit}",
            "speed": f"moves at {value:.4f} {unit}/s, and its limit is {velocity:.4f} {unit}/s",
            "acceleration": f"accelerates by {value:.4f} {unit}/s², and its limit is {acceleration:.4f} {unit}/s²",
        }[kind]
        time = float(curves.begins[piece] + points[point][piece, joint] * curves.spans[piece])
        findings.tell(f"{name} {sentence}", time=time, beyond=float(beyond[point, piece, joint]))
    return inside
