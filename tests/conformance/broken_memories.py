"""Yards that remember what was done there, and heal themselves when they are reset or asked in the order of a run."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
from planted import Planted
from yard import Yard, a_yard

from llm3.types import Failure, FailureKind, Held, MotionProblem, Pose

SMALL = 0.02
"""The radius of the cup, which the robot must not touch, in metres."""


def resetting(self):
    """Resets, and keeps the state."""
    self.state = Yard.reset(self)
    return self.state


def applying(self, state, action, motion):
    """Applies, and keeps the state."""
    after = Yard.apply(self, state, action, motion)
    self.state = after.state
    return after


def preparing(self, state, action, rng):
    """Prepares, and keeps the state."""
    self.state = state
    return Yard.prepare(self, state, action, rng)


def keeping(**parts):
    """A yard that keeps the state of the last reset or apply."""
    return a_yard(reset=resetting, apply=applying, **parts)


def off_the_cup(state, Q):
    """Where the robot is off the cup."""
    if "cup" not in state.poses:
        return np.ones(len(Q), dtype=bool)
    return np.linalg.norm(Q - np.array(state.poses["cup"].position[:2]), axis=1) > SMALL


def around_the_cup(now):
    """Makes motion problems around the cup, where it is in a state that is looked up when somebody asks."""

    def problem(self, state, goal, **others):
        def valid(Q):
            return self.free(Q) & off_the_cup(now(self, state), Q)

        return MotionProblem(state.configuration, (goal,), 0.0, np.array((2.0, 1.0)), valid, 0.01)

    return problem


def taking(self, state, action, motion):
    """Applies, and keeps that the cup was taken once."""
    self.took = getattr(self, "took", False) or action.name == "take"
    return Yard.apply(self, state, action, motion)


def putting(self, state, action, rng):
    """Prepares, and looks at whether the cup was ever taken, and not at whether it is held."""
    if action.name != "put":
        return Yard.prepare(self, state, action, rng)
    if not getattr(self, "took", False):
        return Failure(FailureKind.PRECONDITION, "the cup is not held", objects=("cup",))
    return Yard.prepare(self, replace(state, poses={}, held=Held("cup", Pose((0.0, 0.0, 0.0)))), action, rng)


def way_by_object(self, state, x, y, event):
    """Keeps the goal by what is handled."""
    kept = self.__dict__.setdefault("kept", {})
    x, y = kept.setdefault((event.kind, event.object), (x, y))
    return Yard.query(self, state, x, y, event)


def cached_by_names(self, state):
    """The first state with such objects."""
    return self.__dict__.setdefault("seen", {}).setdefault(tuple(state.poses), state)


LATE = around_the_cup(lambda self, state: self.state)
FAULTS: dict[str, Planted] = {
    "goal of the last state": Planted(
        keeping(goal=lambda self, state: Yard.goal(self, self.state)),
        "describe and goal look at the state that they are given",
        "goal of one state answers differently after applying …: unmet is (…) and then (…).",
        "no field of the Env",
    ),
    "description of the last state": Planted(
        keeping(describe=lambda self, state: Yard.describe(self, self.state)),
        "describe and goal look at the state that they are given",
        "describe of one state answers differently after applying …: it is … and then ….",
        "no field of the Env",
    ),
    "took it once": Planted(
        a_yard(apply=taking, prepare=putting),
        "a new world answers like one in use",
        "a new world prepares put(['cup'], {…}) differently than one in which actions were carried out: …",
        "Keep nothing in the Env",
    ),
    "way by the object": Planted(
        a_yard(query=way_by_object),
        "a new world answers like one in use",
        "a new world prepares … differently than one in which actions were carried out: …",
        "a cache that goes by all that the answer depends on",
    ),
    "obstacles by their names": Planted(
        a_yard(problem=around_the_cup(lambda self, state: cached_by_names(self, state))),
        "a new world answers like one in use",
        "a new world answers the validity test of … differently than one in which actions were carried out: …",
        "a cache that goes by all that the answer depends on",
    ),
    "obstacles of the last reset or apply": Planted(
        keeping(problem=LATE),
        "a motion problem stays what it is",
        "the validity test of … answers (…) differently after …",
        "bind it to the state of its own prepare",
    ),
    "obstacles of the last prepare": Planted(
        a_yard(prepare=preparing, problem=LATE),
        "a motion problem stays what it is",
        "the validity test of … answers (…) differently after preparing …",
        "bind it to the state of its own prepare",
    ),
    "obstacles of whatever was last": Planted(
        keeping(prepare=preparing, problem=LATE),
        "a motion problem stays what it is",
        "the validity test of … answers (…) differently after …",
        "bind it to the state of its own prepare",
    ),
}
SOUND = a_yard(problem=around_the_cup(lambda self, state: state))
"""It goes around the cup, too, and remembers nothing."""
