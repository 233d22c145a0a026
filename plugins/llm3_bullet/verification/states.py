"""Holds the states of a plan against what happened."""

from __future__ import annotations

import numpy as np

from llm3.types import Pose, State
from llm3_bullet.poses import Array
from llm3_bullet.verification.findings import Findings
from llm3_bullet.verification.look import HORIZON
from llm3_bullet.verification.sweep import CONTACT
from llm3_bullet.verification.world import PlainWorld

SETTLED = 0.005
"""How far a box may come to rest from where it was when one was let go, in metres. A plan in which one slides farther
works by luck."""
OVERHANG = 0.006
"""How far the centre of a box may be from being over what it stands on, in metres: the points that are looked at are
almost as far apart."""
ROUNDING = 0.0001
"""Joint values and lengths in states are rounded to this."""


class States:
    """Compares states with a world, and sets the world to them."""

    def __init__(self, world: PlainWorld, findings: Findings) -> None:
        self._world, self._findings = world, findings

    def check(self, state: State, q: Array, released: bool) -> None:
        """Say where the state after an action departs from the world after its motion.

        Args:
            state: What the plan says.
            q: Where the arm is, (dof,).
            released: Whether the action let something go: only then, things that nobody holds may move.
        """
        arm, tell = self._world.arm, self._findings.tell
        apart = np.abs(q - state.configuration)
        joint = int(apart.argmax())
        if apart[joint] > ROUNDING:
            name, unit = arm.joint_names[joint], arm.units[joint]
            tell(
                f"the motion ends with {name} at {q[joint]:.4f} {unit}, and the state after it says "
                f"{state.configuration[joint]:.4f} {unit}"
            )
        self._check_held(state)
        self._check_poses(state, SETTLED if released else ROUNDING)
        self.check_rest()

    def check_rest(self) -> None:
        """See that every box that is not held stands on something, and in nothing."""
        for name in self._world.names:
            if name == self._world.held:
                continue
            near = self._world.neighbours(name)
            for other, gap in near.items():
                if gap < -CONTACT and not (other in self._world.names and other < name):  # each two are told once
                    self._findings.tell(f"{name} rests {-gap * 1000:.2f} mm deep in {other}", depth=-gap)
            gap = min(near.values(), default=HORIZON)
            if gap > CONTACT:
                at_least = "at least " if gap == HORIZON else ""
                self._findings.tell(
                    f"{name} rests on nothing: the next thing is {at_least}{gap * 1000:.2f} mm away", gap=gap
                )
                continue
            beyond = self._world.overhang(name, (other for other, gap in near.items() if gap <= CONTACT))
            if beyond > OVERHANG:
                by = f"is {beyond * 1000:.1f} mm beside" if np.isfinite(beyond) else "is not over any of"
                self._findings.tell(f"{name} cannot rest there: its centre {by} what it touches", overhang=beyond)

    def _check_held(self, state: State) -> None:
        world = self._world
        said = state.held.object if state.held else None
        if said != world.held:
            self._findings.tell(
                f"the gripper holds {world.held or 'nothing'}, and the state after it says {said or 'nothing'}"
            )
        elif state.held and state.held.grasp != world.grasp:
            self._findings.tell(f"{said} is held in another pose than the state after it says")

    def _check_poses(self, state: State, allowed: float) -> None:
        world, tell = self._world, self._findings.tell
        for name in sorted({*world.names, *state.poses}):
            pose = state.poses.get(name)
            if name not in world.names:
                tell(f"the state after it says where {name!r} is, and there is no such thing")
            elif pose is None and name != world.held:
                tell(f"the state after it does not say where {name} is")
            elif pose is not None and name == world.held:
                tell(f"the state after it says where {name} is, which the gripper holds")
            elif pose is not None:
                moved = self._put(name, pose)
                if moved > allowed:
                    tell(f"{name} is {moved * 1000:.2f} mm from where the state after it says", distance=moved)

    def _put(self, name: str, pose: Pose) -> float:
        """Put a box where the state says; how far that moves its corners at most, in metres."""
        before = self._world.corners(name)
        self._world.put(name, pose)
        return float(np.linalg.norm(self._world.corners(name) - before, axis=1).max())
