"""A domain with every capability and no fault, from which the broken ones are made.

A robot in a yard takes a cup through the gap of a wall, puts it down behind it, and rings a bell.
"""

from __future__ import annotations

import json
from dataclasses import dataclass, replace

import numpy as np

from llm3 import Domain, Env, Joint, Option
from llm3.interfaces import PlanVerifier
from llm3.types import (
    Action,
    ActionSchema,
    Contact,
    Defect,
    Entity,
    Event,
    EventKind,
    Failure,
    FailureKind,
    Goal,
    GoalStatus,
    Held,
    MotionProblem,
    NoMotion,
    Parameter,
    Pose,
    Segment,
    Shape,
    Sketch,
    State,
    Transition,
    Verification,
)

ASIDE = 0.05
"""From where the robot reaches for the cup, in metres."""


@dataclass(frozen=True)
class YardInstance:
    cup: tuple[float, float]
    gap: float


class Yard(Env):
    task = "A robot in a yard of 2 by 1 m has to bring the cup past the wall, to x > 1.5 m, and to ring the bell."
    schemas = (
        ActionSchema("take", ("thing",), (), "go to the thing and take it"),
        ActionSchema("put", ("thing",), (Parameter("x", 0, 2, "m"), Parameter("y", 0, 1, "m")), "put it at (x, y)"),
        ActionSchema("ring", (), (), "ring the bell"),
    )
    objects = ("cup",)
    joints = (Joint("east", "m", 1.0, 1.0), Joint("north", "m", 1.0, 1.0))

    def __init__(self, instance):
        self.instance = instance

    def reset(self):
        return State({"cup": Pose((*self.instance.cup, 0.0))}, (0.1, 0.5), None, {"rung": False})

    def describe(self, state):
        where = state.poses["cup"].position if "cup" in state.poses else "in the hand"
        bell = Entity("bell", {"state": "rung" if state.facts["rung"] else "silent"})
        return self.wall(), Entity("cup", {"position": where}), bell, Entity("robot", {"at": state.configuration})

    def wall(self):
        return Entity("wall", {"x range": (0.95, 1.05), "gap": (self.instance.gap - 0.1, self.instance.gap + 0.1)})

    def free(self, Q):
        return (abs(Q[:, 0] - 1.0) > 0.05) | (abs(Q[:, 1] - self.instance.gap) < 0.1)

    def explain(self, q):
        return () if self.free(q[None])[0] else (Contact("robot", "wall", 0.01),)

    def uncertain(self, start, end, steps):
        x = start[0] + np.linspace(0, 1, steps + 1) * (end[0] - start[0])
        return abs(x - 1.0) < 0.06

    def prepare(self, state, action, rng):
        if action.name == "ring":
            if state.facts["rung"]:
                return Failure(FailureKind.PRECONDITION, "the bell has been rung already")
            return NoMotion()
        if action.name == "take":
            if state.held:
                return Failure(FailureKind.PRECONDITION, "the cup is held already", objects=("cup",))
            x, y, _ = state.poses["cup"].position
            return self.query(state, x, y, Event(EventKind.ATTACH, object="cup", grasp=Pose((0.0, 0.0, 0.0))))
        if not state.held:
            return Failure(FailureKind.PRECONDITION, "the cup is not held", objects=("cup",))
        x, y = action.params["x"], action.params["y"]
        return self.query(state, x, y, Event(EventKind.DETACH, object="cup"))

    def query(self, state, x, y, event):
        if x < ASIDE:
            return Failure(FailureKind.UNREACHABLE, "the robot stands west of what it handles")
        if not self.free(np.array([[x, y], [x - ASIDE, y]])).all():
            return Failure(FailureKind.GOAL_IN_COLLISION, objects=("wall",))
        aside, there = (x - ASIDE, y), (x, y)
        goal = Goal(aside, (Segment("approach", (aside, there)), Segment("retreat", (there, aside), (event,))))
        return self.problem(state, goal)

    def problem(self, state, goal, **others):
        fields = {
            "low": np.zeros(2),
            "high": np.array((2.0, 1.0)),
            "valid": self.free,
            "resolution": 0.01,
            "uncertain": self.uncertain,
            "explain": self.explain,
        }
        return MotionProblem(state.configuration, (goal,), **(fields | others))

    def apply(self, state, action, motion):
        if action.name == "ring":
            return Transition(State(state.poses, state.configuration, state.held, {"rung": True}))
        if action.name == "take":
            return Transition(State({}, motion.end, Held("cup", Pose((0.0, 0.0, 0.0))), state.facts))
        pose = Pose((*motion.segments[-1].waypoints[0], 0.0))
        return Transition(State({"cup": pose}, motion.end, None, state.facts))

    def goal(self, state):
        brought = "cup" in state.poses and state.poses["cup"].position[0] > 1.5
        parts = [() if brought else ("the cup is not past the wall",)]
        parts += [() if state.facts["rung"] else ("the bell has not been rung",)]
        unmet = sum(parts, ())
        return GoalStatus(not unmet, unmet)


class YardVerifier(PlanVerifier):
    def __init__(self, env):
        self.env = env

    def verify(self, start, actions):
        here, defects = start, []
        for number, step in enumerate(actions, start=1):
            segments = step.motion.segments
            if segments and not np.allclose(segments[0].waypoints[0], here.configuration, atol=1e-4):
                defects.append(Defect("the robot is not where its motion begins", number, str(step.action)))
            here = step.state
        return Verification((*defects, *map(Defect, self.env.goal(here).unmet)))


class Yards(Domain):
    name = "yard"
    description = "A robot tidies up a yard."
    settings = ("small",)
    default_setting = "small"
    options = (Option("floor", "dry", "what it stands on", ("dry", "wet")), Option("colour", "red", "of the cup"))
    instance_type = YardInstance
    env = Yard
    """What `make` makes."""

    def instance(self, setting, seed):
        x, y, gap = np.random.default_rng(seed).uniform((0.3, 0.2, 0.3), (0.7, 0.8, 0.7))
        return YardInstance((round(float(x), 2), round(float(y), 2)), round(float(gap), 1))

    def make(self, instance, options):
        return self.env(instance)

    def skeleton(self, instance):
        return Sketch("ring"), Sketch("take", ("cup",)), Sketch("put", ("cup",))

    def regions(self, instance):
        return {("put", ("cup",), "x"): (1.3, 2.0)}

    def stand_in(self):
        return tidy

    def remake(self, env, instance, options):
        env.instance = instance
        return env

    def verifier(self, instance, options):
        return YardVerifier(Yard(instance))

    def top_view(self, instance, options, state):
        return (Shape("wall", ((0.95, 0.0), (1.05, 0.0), (1.05, 1.0)), fixed=True),)


def tidy(context, rng):
    x = round(float(rng.uniform(1.6, 1.9)), 2)
    plan = Action("ring"), Action("take", ("cup",)), Action("put", ("cup",), {"x": x, "y": 0.5})
    return json.dumps({"Reasoning": "tidy up", "Full Plan": [str(action) for action in plan]})


def a_yard(**parts):
    """The domain with other parts: those that it has itself replace them, and all others go to its Env."""
    own = {name: part for name, part in parts.items() if hasattr(Yards, name) and name != "__init__"}
    env = type("Yard", (Yard,), {name: part for name, part in parts.items() if name not in own})
    return type("Yards", (Yards,), {"env": env, **own})()


def with_state(change):
    """A yard in which the state after an action is another; the function gets the one before and the one after."""

    def apply(self, state, action, motion):
        after = Yard.apply(self, state, action, motion)
        return replace(after, state=change(state, after.state))

    return a_yard(apply=apply)
