"""Carries out the motions of a plan, and sees what becomes of it."""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass

import numpy as np

from llm3.types import Event, EventKind, Executed, Fact, Held, PlannedAction, Slip, State
from llm3_bullet.execution.hand import Hand
from llm3_bullet.execution.slips import moved, slip_of
from llm3_bullet.execution.tracking import Tracking
from llm3_bullet.execution.world import MotorWorld
from llm3_bullet.kinematics import Kinematics
from llm3_bullet.poses import Array, as_matrix, as_pose
from llm3_bullet.scene import Size


@dataclass(frozen=True, eq=False)
class _Grip:
    """A box in the hand, and how it was there when it was looked at last."""

    name: str
    grasp: Array
    """(4, 4): in the tool frame."""


class Performance:
    """A robot that does what a plan says."""

    def __init__(self, world: MotorWorld, hand: Hand, sizes: Mapping[str, Size], offsets: Array) -> None:
        """Begin, once everything rests.

        Args:
            world: Where it is, at its start.
            hand: What it holds things with.
            sizes: Of the movable boxes, by name.
            offsets: What each joint's encoder reads too much, (dof,).
        """
        self._world, self._hand, self._sizes, self._offsets = world, hand, sizes, offsets
        self._kinematics = Kinematics(world.model)
        self._grip: _Grip | None = None
        self._wait()

    def state(self, facts: Mapping[str, Fact]) -> State:
        """Where everything is now.

        Args:
            facts: What physics does not tell.
        """
        poses, name = self._world.poses(), self._hand.held()
        held = Held(name, as_pose(self._in_hand(name))) if name else None
        if name:
            del poses[name]
        return State(poses, tuple(self._world.configuration.tolist()), held, facts)

    def perform(self, before: State, step: PlannedAction, courses: Sequence[Array]) -> Executed:
        """Carry out an action.

        Args:
            before: Where the plan has everything before it.
            step: The action.
            courses: For each segment, where the arm is meant to be after each time step, (N, dof).
        """
        world, tracking = self._world, Tracking()
        began, stood = world.ticks, {name: world.box(name) for name in world.movable}
        slips: list[Slip] = []
        for segment, course in zip(step.motion.segments, courses, strict=True):
            for event in segment.events:
                slips += self._carry_out(event)
            self._follow(course, tracking)
        self._wait()
        slips += self._look_at_grip()
        handled = {event.object for event in step.motion.events}
        slips += self._look_around(stood, before, step.state, handled)
        slips += () if slips else self._look_at_hand(step.state)
        seconds = (world.ticks - began) * world.time_step
        return Executed(step.action, seconds, tracking.joint, tracking.rms, tracking.tool, tuple(slips))

    # ---- what it does ---------------------------------------------------------------------------------

    def _follow(self, course: Array, tracking: Tracking) -> None:
        world, true = self._world, np.empty_like(course)
        for index, meant in enumerate(course):
            world.drive(meant - self._offsets)
            self._hand.look_after()
            true[index] = world.configuration
        tracking.add(true + self._offsets, true, course, self._kinematics)

    def _carry_out(self, event: Event) -> Iterator[Slip]:
        """Do what happens at a standstill, and wait until it is done."""
        hand, name = self._hand, event.object
        if event.kind is EventKind.GRIPPER and event.opening is not None:
            hand.open_to(event.opening)
            self._wait()
            hand.relax()
        elif event.kind is EventKind.ATTACH and name is not None and event.grasp is not None:
            hand.take(name, self._sizes[name])
            self._wait()
            if hand.held() == name:
                self._grip = _Grip(name, self._in_hand(name))
                yield from slip_of(self._grip.grasp, as_matrix(event.grasp), f"{name} was taken {{}} beside the plan")
            else:
                yield Slip(f"{name} was not taken: {hand.missed(name)}")
        elif event.kind is EventKind.DETACH and name is not None:
            yield from self._look_at_grip()
            if hand.held() != name:
                yield Slip(f"{name} was not in the gripper when it was to be let go")
            self._grip = None
            hand.let_go()
            self._wait()

    def _wait(self) -> None:
        """Stand still until everything rests."""
        world, resting = self._world, 0
        for _ in range(round(world.settings.longest_wait / world.time_step)):
            world.stay()
            self._hand.look_after()
            resting = resting + 1 if world.rests() else 0
            if resting == world.settings.boxes.steps_at_rest:
                return

    # ---- what it sees ---------------------------------------------------------------------------------

    def _in_hand(self, name: str) -> Array:
        """A box's frame in the tool frame, (4, 4)."""
        return np.asarray(np.linalg.inv(self._world.tool()) @ self._world.box(name))

    def _look_at_grip(self) -> Iterator[Slip]:
        """How what was taken is in the hand now."""
        if self._grip is None:
            return
        name, before = self._grip.name, self._grip.grasp
        if self._hand.held() != name:
            self._grip = None
            yield Slip(f"{name} slipped out of the gripper")
            return
        self._grip = _Grip(name, self._in_hand(name))
        yield from slip_of(self._grip.grasp, before, f"{name} slipped by {{}} in the gripper")

    def _look_at_hand(self, after: State) -> Iterator[Slip]:
        """What is in the hand after the action, and should not be, or the other way round."""
        held, meant = self._hand.held(), after.held.object if after.held else None
        if held != meant:
            what = f"{meant} is not in the gripper, and should be" if meant else f"{held} is still in the gripper"
            yield Slip(what)

    def _look_around(
        self, stood: Mapping[str, Array], before: State, after: State, handled: set[str | None]
    ) -> Iterator[Slip]:
        """Boxes that stand elsewhere than they should after the action."""
        held = self._hand.held()
        for name, frame in stood.items():
            if name in (held, self._grip and self._grip.name) or name not in after.poses:
                continue
            now, planned = self._world.box(name), as_matrix(after.poses[name])
            if name in handled or name not in before.poses:
                yield from slip_of(now, planned, f"{name} came to rest {{}} from where the plan has it")
            else:
                way = moved(frame, now, as_matrix(before.poses[name]), planned)
                yield from slip_of(*way, f"{name} was moved by {{}} against the plan")
