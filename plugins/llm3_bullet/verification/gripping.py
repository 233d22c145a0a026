"""What the gripper does at a standstill, and whether it makes sense."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

from llm3.types import Event, EventKind, Pose
from llm3_bullet.poses import Array
from llm3_bullet.verification.boxes import Frame, surface_distance
from llm3_bullet.verification.findings import Findings
from llm3_bullet.verification.sweep import line, sweep
from llm3_bullet.verification.world import PlainWorld

JUMP = 0.0005
"""How far a box may seem to jump into the gripper, in metres: the rounding of states and waypoints."""
GRIP = 0.002
"""How deep a finger may be in what it takes, and how far from it a cup, in metres: rounding, and the hulls' margin."""
SQUARELY = 0.9
"""Cosine of the angle between the closing direction and the way from a finger to what it takes: it may not be less."""
_OPENING = 1e-9


class Gripping:
    """The gripper of a playback, which starts wide open."""

    def __init__(self, world: PlainWorld, findings: Findings) -> None:
        self._world, self._findings = world, findings
        self._max_opening = world.arm.description.gripper.max_opening
        self.opening = self._max_opening
        """Distance between the fingers in metres."""
        self.let_go: dict[str, Frame] = {}
        """Where boxes were when they were let go."""

    def carry_out(self, events: Sequence[Event], q: Array) -> None:
        """Let events happen while the arm stands at q, (dof,)."""
        for index, event in enumerate(events):
            if event.kind is EventKind.GRIPPER and event.opening is not None:
                self._world.spare(_handled(events, index))
                self._move_fingers(event.opening, q)
                self._world.spare(None)
            elif event.kind is EventKind.ATTACH and event.object is not None and event.grasp is not None:
                self._take(event.object, event.grasp)
            elif event.kind is EventKind.DETACH and event.object is not None:
                self._release(event.object)
            else:
                lacks = "opening" if event.kind is EventKind.GRIPPER else "object or grasp"
                self._findings.tell(f"an event of the kind '{event.kind.value}' lacks its {lacks}")

    def _move_fingers(self, opening: float, q: Array) -> None:
        world, tell = self._world, self._findings.tell
        if not -_OPENING <= opening <= self._max_opening + _OPENING:
            tell(f"the gripper is to open to {opening:g} m, and its range is 0 to {self._max_opening:g} m")
            return
        if world.held and abs(opening - self.opening) > _OPENING:
            tell(f"the gripper moves from {self.opening:g} to {opening:g} m while it holds {world.held}")
        for _, look in sweep(world, line(np.append(q, self.opening), np.append(q, opening))):
            self._findings.see(look, 0.0)
        self.opening = opening
        world.move(np.append(q, opening))

    def _take(self, name: str, grasp: Pose) -> None:
        world, tell = self._world, self._findings.tell
        if name not in world.names:
            tell(f"the gripper takes {name!r}, and there is no such thing; there are {', '.join(world.names)}")
        elif world.held:
            tell(f"the gripper takes {name} while it holds {world.held}")
        else:
            self._check_touch(name)
            jump = world.attach(name, grasp)
            if jump > JUMP:
                tell(f"{name} jumps by {jump * 1000:.2f} mm into the gripper", jump=jump)

    def _check_touch(self, name: str) -> None:
        """See that both fingers, or the whole rim of the cup, touch a box, and that no part of the gripper is in it."""
        world, arm, tell = self._world, self._world.arm, self._findings.tell
        for link in sorted(arm.gripper):
            distance, way = world.nearest(name, link)
            if distance < -GRIP:
                tell(
                    f"{arm.link_names[link]} is {-distance * 1000:.2f} mm deep in {name}, which it takes", gap=distance
                )
            elif link in arm.fingers and distance > JUMP:
                tell(f"{arm.link_names[link]} is {distance * 1000:.2f} mm from {name}, which it takes", gap=distance)
            elif link in arm.fingers and abs(float(way @ arm.closing_direction())) < SQUARELY:
                tell(f"{arm.link_names[link]} touches {name}, which it takes, but does not close on it")
        rim = arm.rim()
        if len(rim):
            distances = surface_distance(rim, world.frame(name), world.sizes[name])
            off = float(distances[np.abs(distances).argmax()])
            if abs(off) > GRIP:
                tell(f"the cup's rim is {abs(off) * 1000:.2f} mm from the surface of {name}, which it takes", gap=off)

    def _release(self, name: str) -> None:
        world = self._world
        if world.held != name:
            self._findings.tell(f"the gripper lets go of {name!r}, and holds {world.held or 'nothing'}")
            return
        self.let_go[name] = world.frame(name)
        world.detach()


def _handled(events: Sequence[Event], index: int) -> str | None:
    """What the gripper takes right after an event, or has let go right before it."""
    after, before = events[index + 1 : index + 2], events[max(0, index - 1) : index]
    names = [e.object for e in after if e.kind is EventKind.ATTACH] + [
        e.object for e in before if e.kind is EventKind.DETACH
    ]
    return names[0] if names else None
