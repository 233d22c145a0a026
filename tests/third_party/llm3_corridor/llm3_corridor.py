"""A point robot walks down a corridor. A wall crosses it, with a gap somewhere."""

from dataclasses import dataclass

import numpy as np

from llm3 import Domain, Env, hookimpl
from llm3.types import (
    ActionSchema,
    Entity,
    Failure,
    FailureKind,
    Goal,
    GoalStatus,
    MotionProblem,
    Parameter,
    Sketch,
    State,
    Transition,
)


@dataclass(frozen=True)
class CorridorInstance:
    gap: float
    """Where the gap's centre is, in metres from the right-hand side; it is 0.2 m wide."""


class CorridorEnv(Env):
    task = "A point robot stands in a corridor 2 m long (x) and 1 m wide (y). It has to get to where x > 1.8 m."
    schemas = (ActionSchema("go", (), (Parameter("x", 0, 2, "m"), Parameter("y", 0, 1, "m")), "walk to (x, y)"),)
    objects = ()

    def __init__(self, instance):
        self.gap = instance.gap

    def reset(self):
        return State(configuration=(0.1, 0.5))

    def describe(self, state):
        robot = Entity("robot", {"position": state.configuration})
        gap = (round(self.gap - 0.1, 3), round(self.gap + 0.1, 3))
        return robot, Entity("wall", {"x range": (0.9, 1.1), "gap": gap})

    def free(self, Q):  # one row a position: a planner asks for many at once
        return (abs(Q[:, 0] - 1.0) > 0.1) | (abs(Q[:, 1] - self.gap) < 0.1)

    def prepare(self, state, action, rng):
        target = (action.params["x"], action.params["y"])
        if not self.free(np.array([target]))[0]:
            return Failure(FailureKind.GOAL_IN_COLLISION, objects=("wall",))
        return MotionProblem(state.configuration, (Goal(target),), 0.0, (2.0, 1.0), self.free, resolution=0.01)

    def apply(self, state, action, motion):
        return Transition(State(configuration=motion.end))

    def goal(self, state):
        arrived = state.configuration[0] > 1.8
        return GoalStatus(arrived, () if arrived else ("the robot is not at the end of the corridor",))


class Corridor(Domain):
    name = "corridor"
    description = "A point robot walks down a corridor."
    settings = ("default",)
    default_setting = "default"
    instance_type = CorridorInstance

    def instance(self, setting, seed):
        return CorridorInstance(gap=round(float(np.random.default_rng(seed).uniform(0.2, 0.8)), 2))

    def make(self, instance, options):
        return CorridorEnv(instance)

    def skeleton(self, instance):
        return (Sketch("go"), Sketch("go"))


@hookimpl
def llm3_domains():
    return {"corridor": Corridor}
