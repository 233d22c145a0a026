"""A second opinion on a plan: it is played in a plain world, and whatever is wrong with it is a defect."""

from __future__ import annotations

from dataclasses import dataclass, field
from itertools import pairwise

import numpy as np
from numpy.typing import NDArray
from plain_world import PlainWorld

from llm3.records import PlanFile
from llm3.types import Event, EventKind, Segment, State
from llm3_boxpack.instance import BoxpackInstance
from llm3_boxpack.layout import furniture
from llm3_bullet.robots.panda import panda
from llm3_bullet.scene import Box

ALLOWED_DEPTH = 0.001
"""Metres; PyBullet's hulls have a margin of this size."""
TRANSIT_STEP = 0.0084
"""Sum of joint changes in radians between two samples that is no more than the planner's own step."""
STRAIGHT_STEP = 0.002
"""The planner's own step on straight pieces, in metres of the tool."""
JUMP = 0.0005
"""How far a box may seem to jump into the hand, in metres: rounding of states."""
SETTLED = 0.005
"""How far a box may come to rest from where the hand let go of it, in metres. One that slides farther is a defect:
such a plan works by luck."""


@dataclass
class Recheck:
    """Plays one plan in a world of its own and collects what is wrong with it."""

    plan: PlanFile
    instance: BoxpackInstance
    finer: int = 4
    """How much finer than the planner's step."""
    defects: list[str] = field(default_factory=list)
    configurations: int = 0
    deepest: float = 0.0
    """The deepest contact that was seen, in metres."""

    def run(self) -> list[str]:
        """Play the plan once; the answer is what is wrong with it."""
        plan = self.plan
        fixed = furniture(self.instance.basket, float(plan.options["walls"]))
        boxes = tuple(Box(box.name, box.size, plan.start.poses[box.name]) for box in self.instance.boxes)
        with PlainWorld(panda(), [joint.name for joint in plan.joints], fixed, boxes) as self._world:
            self._at = np.array(plan.start.configuration)
            for number, step in enumerate(plan.actions, start=1):
                where = f"action {number} {step.action}"
                for segment in step.motion.segments:
                    self._play(segment, f"{where}, {segment.label}")
                self._compare(step.state, where)
            self._goal()
        return self.defects

    def _play(self, segment: Segment, where: str) -> None:
        waypoints = np.array(segment.waypoints)
        gap = np.abs(waypoints[0] - self._at).max()
        if gap > 1e-9:
            self.defects.append(f"{where}: begins {gap:.2e} rad from where the arm is")
        low, high = self._world.limits.T
        if (waypoints < low - 1e-9).any() or (waypoints > high + 1e-9).any():
            self.defects.append(f"{where}: leaves the joint limits")
        self._world.move(waypoints[0])
        for event in segment.events:
            self._happen(event, where)
        for a, b in pairwise(waypoints):
            for t in np.linspace(0.0, 1.0, self._samples(a, b, segment.label)):
                self._world.move(a + t * (b - a))
                self._look(where)
        self._at = waypoints[-1]

    def _samples(self, a: NDArray[np.float64], b: NDArray[np.float64], label: str) -> int:
        if label == "transit":
            steps = np.abs(b - a).sum() / TRANSIT_STEP
        else:
            tools = []
            for q in (a, b):
                self._world.move(q)
                tools.append(self._world.tool())
            steps = np.linalg.norm(tools[1] - tools[0]) / STRAIGHT_STEP
        return int(np.ceil(self.finer * steps)) + 1

    def _happen(self, event: Event, where: str) -> None:
        world = self._world
        if event.kind is EventKind.GRIPPER and event.opening is not None:
            world.opening = event.opening
            world.move(self._at)
        elif event.kind is EventKind.ATTACH and event.object and event.grasp:
            jump = world.attach(event.object, event.grasp)
            if jump > JUMP:
                self.defects.append(f"{where}: {event.object} jumps {jump * 1000:.2f} mm into the gripper")
            gap = world.finger_gap(event.object)
            if abs(gap) > 2 * ALLOWED_DEPTH:
                self.defects.append(f"{where}: the fingers are {gap * 1000:.2f} mm from {event.object}")
        elif event.kind is EventKind.DETACH and event.object == world.held:
            world.detach()
        else:
            self.defects.append(f"{where}: {event.kind.value} of {event.object} makes no sense here")

    def _look(self, where: str) -> None:
        self.configurations += 1
        for depth, what in self._world.touches():
            self.deepest = max(self.deepest, depth)
            if depth > ALLOWED_DEPTH:
                self.defects.append(f"{where}: {what}, {depth * 1000:.2f} mm deep")

    def _compare(self, state: State, where: str) -> None:
        world = self._world
        held = state.held.object if state.held else None
        if held != world.held:
            self.defects.append(f"{where}: holds {world.held}, the plan says {held}")
        if np.abs(self._at - state.configuration).max() > 1e-9:
            self.defects.append(f"{where}: the arm is not where the plan says")
        for name, pose in state.poses.items():
            before = world.corners(name)
            world.put(name, pose)
            if np.linalg.norm(world.corners(name) - before, axis=1).max() > SETTLED:
                self.defects.append(f"{where}: {name} is not where the plan says")

    def _goal(self) -> None:
        (x, y), (dx, dy) = self.instance.basket.center, self.instance.basket.size
        for box in self.instance.boxes:
            corners = self._world.corners(box.name)[:, :2]
            out = float((np.abs(corners - (x, y)) - (dx / 2, dy / 2)).max())
            if out > ALLOWED_DEPTH or box.name == self._world.held:
                self.defects.append(f"{box.name} ends {out * 1000:.1f} mm out of the basket")
