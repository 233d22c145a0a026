"""Plays the actions of a plan one after another, and tells what is wrong with them."""

from __future__ import annotations

from itertools import pairwise

import numpy as np

from llm3.types import PlannedAction, Segment, State
from llm3_bullet.poses import Array
from llm3_bullet.verification.boxes import Frame
from llm3_bullet.verification.findings import Findings, figure
from llm3_bullet.verification.gripping import Gripping
from llm3_bullet.verification.states import States
from llm3_bullet.verification.sweep import line, sweep
from llm3_bullet.verification.timing import check_trajectory
from llm3_bullet.verification.world import PlainWorld

EXACT = 1e-9
"""Radians or metres: joint values that differ by less are the same."""


class Playback:
    """A plan on its way through a world of its own.

    What is looked at: joint limits; whether each piece begins where the last one ended; whether what is taken is where
    the gripper is, touches it, and is let go again; contacts all along; and whether the states in the plan say what
    happened. Where they do, they are believed for what comes next, because physics moves a box that was let go.
    """

    def __init__(self, world: PlainWorld, start: State) -> None:
        """Set the world to the start.

        Args:
            world: Where to play it; nothing is held in it.
            start: Holds nothing, and says of each movable box where it is.
        """
        self.world, self.findings = world, Findings()
        self._at: Array = np.array(start.configuration)
        self._gripping = Gripping(world, self.findings)
        self._states = States(world, self.findings)
        for name, pose in start.poses.items():
            world.put(name, pose)
        world.move(self._joined(self._at))
        self._states.check_rest()

    @property
    def let_go(self) -> dict[str, Frame]:
        """Where the boxes that the last action let go were at that moment, by name."""
        return self._gripping.let_go

    def play(self, step: PlannedAction) -> None:
        """Play the next action."""
        self.findings.begin_action(step)
        self._gripping.let_go.clear()
        for segment in step.motion.segments:
            self.findings.begin_segment(segment.label)
            self._play(segment)
            self.findings.end_segment()
        self._states.check(step.state, self._at, released=bool(self.let_go))

    def _play(self, segment: Segment) -> None:
        waypoints = np.array(segment.waypoints)
        jumps = np.abs(waypoints[0] - self._at)
        joint = int(jumps.argmax())
        if jumps[joint] > EXACT:
            name, unit = self.world.arm.joint_names[joint], self.world.arm.units[joint]
            self.findings.tell(
                f"the segment begins where the arm is not: {name} jumps by {jumps[joint]:.4g} {unit}",
                jump=float(jumps[joint]),
            )
        self._at = waypoints[0]
        self.world.move(self._joined(self._at))
        self._gripping.carry_out(segment.events, self._at)
        inside = self._check_limits(waypoints)
        for index, (a, b) in enumerate(pairwise(waypoints) if inside else ()):
            for u, look in sweep(self.world, line(self._joined(a), self._joined(b))):
                self.findings.see(look, index + u)
        if segment.trajectory and inside:
            opening = self._gripping.opening
            check_trajectory(self.world, segment.trajectory, segment.waypoints, opening, self.findings)
        self._at = waypoints[-1]
        self.world.move(self._joined(self._at))

    def _check_limits(self, waypoints: Array) -> bool:
        """Whether the piece stays within the joint limits; one that does not is looked at no further."""
        low, high = self.world.arm.limits.T
        beyond = np.maximum(low - waypoints, waypoints - high)
        index, joint = np.unravel_index(int(beyond.argmax()), beyond.shape)
        if beyond[index, joint] <= EXACT:
            return True
        name, unit, value = self.world.arm.joint_names[joint], self.world.arm.units[joint], waypoints[index, joint]
        self.findings.tell(
            f"{name} is at {figure(value)} {unit}, and its limits are {low[joint]:.4f} and {high[joint]:.4f} {unit}",
            float(index),
            beyond=float(beyond[index, joint]),
        )
        return False

    def _joined(self, q: Array) -> Array:
        return np.append(q, self._gripping.opening)
