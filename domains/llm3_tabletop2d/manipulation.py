"""What each action asks of the robot: where it has to go, and the straight pieces from there."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from math import atan2

import numpy as np

from llm3.types import (
    Event,
    EventKind,
    Failure,
    FailureKind,
    Goal,
    NoMotion,
    State,
    Vector,
)
from llm3_tabletop2d.actions import LARGEST_CARRIED, too_large
from llm3_tabletop2d.bodies import Body, Separation
from llm3_tabletop2d.contact import beside
from llm3_tabletop2d.instance import Pair
from llm3_tabletop2d.reach import cut_off
from llm3_tabletop2d.scene import Scene, rounded, shifted, xy
from llm3_tabletop2d.straight import End, Leg, offered
from llm3_tabletop2d.ways import is_free

TOUCH = 0.001
"""Distance in metres between the robot and what it takes hold of: both are round or have corners, and never overlap."""
STANDOFF = 0.012
"""Distance in metres from which the robot comes straight up to a thing, and to which it backs off again."""


@dataclass(frozen=True)
class Stand:
    """Two places of the robot beside a thing, seen from the thing's centre."""

    contact: Vector
    """Where it takes hold of it."""
    off: Vector
    """Where it comes from and goes back to."""


class Manipulation:
    """Picks, places and pushes in one problem."""

    def __init__(self, scene: Scene, room: Pair) -> None:
        """Take the bodies, and the side lengths of the room in metres."""
        self._scene, self._radius = scene, scene.robot.radius
        self.low = np.array((self._radius, self._radius))
        """Where the robot's centre can be at all: the lower bounds of x and y, in metres."""
        self.high = np.maximum(np.array(room) - self._radius, self.low)
        """The upper ones."""

    def pick(self, state: State, name: str, angle: float) -> Goal | Failure:
        """Take hold of an object from the side of an angle."""
        if state.held:
            return _not_possible(f"The robot already holds {state.held.object}, so it cannot pick {name}.")
        item = self._scene.items[name]
        if too_large(item):
            return _not_possible(
                f"{name} is too large to be carried: its longest side is {max(item.size):g} m, and the robot carries "
                f"up to {LARGEST_CARRIED:g} m. It can be pushed."
            )
        pose = state.poses[name]
        at, stand = xy(pose), self._stand(self._scene.body(name, pose), angle)
        contact, off = rounded(at + stand.contact), rounded(at + stand.off)
        grasp = shifted(pose, -contact)
        held = self._scene.body(name, grasp)
        others = self._scene.standing(state, without=name)
        approach = Leg("approach", off, contact, self._scene.moving(None), others)
        attach = Event(EventKind.ATTACH, object=name, grasp=grasp)
        withdraw = Leg("withdraw", contact, off, self._scene.moving(held), others, attach)
        before, after = self._scene.standing(state), (off, self._scene.moving(held), others)
        return self._goal((approach, withdraw), (off, self._scene.moving(None), before), after)

    def place(self, state: State, name: str, target: Vector) -> Goal | Failure:
        """Bring the held object to where its centre is at the target, (2,)."""
        if state.held is None:
            return _not_possible(f"The robot holds nothing, so it cannot place {name}: pick {name} first.")
        if state.held.object != name:
            return _not_possible(f"The robot holds {state.held.object}, so it cannot place {name}: pick {name} first.")
        offset = xy(state.held.grasp)
        contact = rounded(target - offset)
        pose = shifted(state.held.grasp, contact)
        stand = self._stand(self._scene.body(name, pose), atan2(-offset[1], -offset[0]))
        off = rounded(xy(pose) + stand.off)
        held = self._scene.body(name, state.held.grasp)
        others = self._scene.standing(state)
        advance = Leg("advance", off, contact, self._scene.moving(held), others)
        detach = Event(EventKind.DETACH, object=name)
        retreat = Leg("retreat", contact, off, self._scene.moving(None), others, detach)
        after = (*others, self._scene.body(name, pose))
        ends = (off, self._scene.moving(held), others), (off, self._scene.moving(None), after)
        return self._goal((advance, retreat), *ends)

    def push(self, state: State, name: str, target: Vector) -> Goal | NoMotion | Failure:
        """Push an object along a straight line to where its centre is at the target, (2,)."""
        if state.held:
            return _not_possible(
                f"The robot holds {state.held.object}, so it cannot push {name}: place {state.held.object} first."
            )
        pose = state.poses[name]
        at, target = xy(pose), rounded(target)
        way = target - at
        if not rounded(way).any():
            return NoMotion()
        stand = self._stand(self._scene.body(name, pose), atan2(-way[1], -way[0]))
        contact, off = rounded(at + stand.contact), rounded(at + stand.off)
        grasp = shifted(pose, -contact)
        pushed = self._scene.body(name, grasp)
        others = self._scene.standing(state, without=name)
        end, back = rounded(contact + way), rounded(off + way)
        after = (*others, self._scene.body(name, shifted(pose, way)))
        attach, detach = Event(EventKind.ATTACH, object=name, grasp=grasp), Event(EventKind.DETACH, object=name)
        alone = self._scene.moving(None)
        legs = (
            Leg("approach", off, contact, alone, others),
            Leg("push", contact, end, self._scene.moving(pushed), others, attach, "pushed"),
            Leg("retreat", end, back, alone, others, detach),
        )
        return self._goal(legs, (off, alone, self._scene.standing(state)), (back, alone, after))

    def cut_off(self, state: State, name: str, separation: Separation, goal: Goal) -> Failure | None:
        """That there is no way to a goal, where that can be proven.

        Args:
            state: Where the robot is, and whether it stands free; if it does not, the planner tells that.
            name: The object that the action is about; it is not to blame.
            separation: Of the robot and what it holds from everything else.
            goal: Where it is to go.
        """
        start, end = np.array(state.configuration), np.array(goal.configuration)
        if not is_free(separation, start[None]).all():
            return None
        others = [other for other in state.poses if other != name]
        culprits = cut_off(separation, self.low, self.high, start, end, others)
        if culprits is None:
            return None
        who = f"the robot and {state.held.object}" if state.held else "the robot"
        detail = f"It is cut off: no gap on the way there is wide enough for {who}."
        if culprits:
            detail += f" {culprits[0]} is in the way."
        return Failure(FailureKind.UNREACHABLE, detail, culprits, configuration=goal.configuration)

    def _stand(self, body: Body, angle: float) -> Stand:
        return Stand(beside(body, angle, self._radius + TOUCH), beside(body, angle, self._radius + STANDOFF))

    def _goal(self, legs: Sequence[Leg], *ends: End) -> Goal | Failure:
        return offered(legs, ends, self.low, self.high)


def _not_possible(detail: str) -> Failure:
    return Failure(FailureKind.PRECONDITION, detail)
