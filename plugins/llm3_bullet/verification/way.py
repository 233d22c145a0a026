"""Whether a trajectory goes the way of its waypoints."""

from __future__ import annotations

from itertools import pairwise

import numpy as np

from llm3.types import Trajectory, Waypoints
from llm3_bullet.poses import Array
from llm3_bullet.verification.curves import Curves
from llm3_bullet.verification.findings import Findings, figure
from llm3_bullet.verification.world import PlainWorld

SAME = 1e-6
"""Radians or metres, and per second: joint values and speeds that differ by less are the same."""
ASIDE = 1e-3
"""Radians or metres: how far a joint may be from the straight way between two waypoints. It is twice what the timer of
llm3 allows itself, for others are not as strict."""
LOOKS = np.arange(1, 8) / 8
"""Where in each polynomial that is looked at, besides its ends."""


def has_same_ends(world: PlainWorld, trajectory: Trajectory, waypoints: Waypoints, findings: Findings) -> bool:
    """Tell where it does not begin or end with the waypoints, at rest; whether it has their ends."""
    names, units = world.arm.joint_names, world.arm.units
    same = True
    for verb, end in (("begins", 0), ("ends", -1)):
        position, velocity = np.array(trajectory.positions[end]), np.array(trajectory.velocities[end])
        time = trajectory.times[end]
        apart = np.abs(position - waypoints[end])
        joint = int(apart.argmax())
        if apart[joint] > SAME:
            same = False
            findings.tell(
                f"the trajectory {verb} with {names[joint]} at {figure(position[joint])} {units[joint]}, and the "
                f"waypoints at {figure(waypoints[end][joint])} {units[joint]}",
                time=time,
            )
        joint = int(np.abs(velocity).argmax())
        if abs(velocity[joint]) > SAME:
            findings.tell(
                f"the trajectory {verb} while {names[joint]} moves at {figure(velocity[joint])} {units[joint]}/s",
                time=time,
            )
    return same


def check_way(
    world: PlainWorld, trajectory: Trajectory, curves: Curves, waypoints: Waypoints, findings: Findings
) -> None:
    """Tell which waypoint it passes by, and where it is farthest from the straight ways between them."""
    path, positions = np.array(waypoints), np.array(trajectory.positions)
    knots = [0]  # the times at which it is at the waypoints
    for number, waypoint in enumerate(path[1:], start=1):
        apart = np.abs(positions[knots[-1] :] - waypoint).max(axis=1)
        met = np.flatnonzero(apart <= SAME)
        if not len(met):
            findings.tell("the trajectory does not pass through the waypoint", float(number))
            return
        knots.append(knots[-1] + int(met[0]))
    worst = (ASIDE, 0, 0.0, 0)  # how far, after which waypoint, when, which joint
    for number, (first, last) in enumerate(pairwise(knots)):
        for piece in range(first, last):
            seen = np.vstack([positions[piece], *(curves.positions(np.array(u))[piece] for u in LOOKS)])
            off = np.abs(seen - _nearest(seen, path[number], path[number + 1]))
            look, joint = divmod(int(off.argmax()), off.shape[1])
            if off[look, joint] > worst[0]:
                time = curves.begins[piece] + curves.spans[piece] * look / (len(LOOKS) + 1)
                worst = (float(off[look, joint]), number, float(time), joint)
    off_way, number, time, joint = worst
    if off_way > ASIDE:
        findings.tell(
            f"the trajectory is off the straight way from waypoint {number} to {number + 1}: "
            f"{world.arm.joint_names[joint]} by {figure(off_way)} {world.arm.units[joint]}",
            time=time,
            off=off_way,
        )


def _nearest(points: Array, a: Array, b: Array) -> Array:
    """The nearest to each of the points (N, dof) on the straight way from a to b."""
    way = b - a
    length = float(way @ way)
    along = np.clip((points - a) @ way / length, 0.0, 1.0) if length else np.zeros(len(points))
    return np.asarray(a + along[:, None] * way)
