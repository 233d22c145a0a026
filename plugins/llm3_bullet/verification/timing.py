"""Looks at a piece of motion in time: where it goes, how fast, and how hard it accelerates."""

from __future__ import annotations

import numpy as np

from llm3.types import Trajectory, Waypoints
from llm3_bullet.verification.curves import Curves, curves_of
from llm3_bullet.verification.findings import Findings, figure
from llm3_bullet.verification.sweep import cubic, sweep
from llm3_bullet.verification.way import check_way, has_same_ends
from llm3_bullet.verification.world import PlainWorld

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
    curves = curves_of(trajectory)
    if has_same_ends(world, trajectory, waypoints, findings):
        check_way(world, trajectory, curves, waypoints, findings)
    inside = _check_limits(world, curves, findings)
    velocities = np.array(trajectory.velocities)
    for index, (begin, span) in enumerate(zip(curves.begins, curves.spans, strict=True)) if inside else ():
        a, b = (np.append(trajectory.positions[i], opening) for i in (index, index + 1))
        derivatives = (np.append(velocities[i] * span, 0.0) for i in (index, index + 1))
        for u, look in sweep(world, cubic(a, b, *derivatives)):
            findings.see(look, time=begin + u * span)


def _check_limits(world: PlainWorld, curves: Curves, findings: Findings) -> bool:
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
            "position": f"is at {figure(value)} {unit}, and its limits are {low[joint]:.4f} and {high[joint]:.4f} "
            f"{unit}",
            "speed": f"moves at {figure(value)} {unit}/s, and its limit is {velocity:.4f} {unit}/s",
            "acceleration": f"accelerates by {figure(value)} {unit}/s², and its limit is {acceleration:.4f} {unit}/s²",
        }[kind]
        time = float(curves.begins[piece] + points[point][piece, joint] * curves.spans[piece])
        findings.tell(f"{name} {sentence}", time=time, beyond=float(beyond[point, piece, joint]))
    return inside
