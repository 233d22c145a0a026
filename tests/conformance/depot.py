"""A domain with several objects, two facts and no motion at all, from which broken ones are made.

A robot in a depot takes parcels, stows them in lockers and charges itself.
"""

from __future__ import annotations

import json
from dataclasses import dataclass, replace

import numpy as np

from llm3 import Domain, Env
from llm3.types import (
    Action,
    ActionSchema,
    Entity,
    Failure,
    FailureKind,
    GoalStatus,
    Held,
    NoMotion,
    Parameter,
    Pose,
    State,
    Transition,
)

LOCKERS = {"east": 2.0, "west": 0.0}
GRASP = Pose((0.0, 0.0, 0.0))


@dataclass(frozen=True)
class DepotInstance:
    parcels: tuple[float, ...]


class Depot(Env):
    task = "A robot has to stow all parcels in the locker named east, at x = 2 m."
    schemas = (
        ActionSchema("take", ("parcel",), (), "take the parcel"),
        ActionSchema(
            "stow", ("parcel", "locker"), (Parameter("depth", 0.0, 0.5, "m"),), "put the parcel in the locker"
        ),
        ActionSchema("charge", (), (), "charge the battery"),
    )

    def __init__(self, instance):
        self.instance = instance

    @property
    def parcels(self):
        return tuple(f"parcel_{i}" for i in range(len(self.instance.parcels)))

    @property
    def objects(self):
        return (*self.parcels, *LOCKERS)

    def reset(self):
        poses = {name: Pose((x, 0.5, 0.0)) for name, x in zip(self.parcels, self.instance.parcels, strict=True)}
        return State(poses, (), None, {"charged": False, "taken": 0})

    def where(self, state, name):
        return {"position": state.poses[name].position[:2]} if name in state.poses else {"place": "in the hand"}

    def describe(self, state):
        parcels = (Entity(name, self.where(state, name)) for name in self.parcels)
        lockers = (Entity(name, {"x": x}) for name, x in LOCKERS.items())
        robot = {"battery": "full" if state.facts["charged"] else "low", "parcels taken": state.facts["taken"]}
        return *parcels, *lockers, Entity("robot", robot)

    def refusal(self, state, action):
        if action.name == "take":
            (name,) = action.objects
            if name not in self.parcels:
                return f"{name} is no parcel"
            return "the hand is not empty" if state.held else ""
        if action.name == "stow":
            name, locker = action.objects
            if locker not in LOCKERS:
                return f"{locker} is no locker"
            return "" if state.held and state.held.object == name else f"{name} is not held"
        return ""

    def prepare(self, state, action, rng):
        why = self.refusal(state, action)
        return Failure(FailureKind.PRECONDITION, why, objects=action.objects) if why else NoMotion()

    def apply(self, state, action, motion):
        poses, facts = dict(state.poses), dict(state.facts)
        if action.name == "charge":
            return Transition(replace(state, facts=facts | {"charged": True}))
        if action.name == "take":
            del poses[action.objects[0]]
            taken = facts | {"taken": facts["taken"] + 1}
            return Transition(replace(state, poses=poses, held=Held(action.objects[0], GRASP), facts=taken))
        poses[action.objects[0]] = Pose((LOCKERS[action.objects[1]], action.params["depth"], 0.0))
        return Transition(replace(state, poses=poses, held=None))

    def goal(self, state):
        there = {name for name, pose in state.poses.items() if pose.position[0] == LOCKERS["east"]}
        unmet = tuple(f"{name} is not in the locker east" for name in self.parcels if name not in there)
        return GoalStatus(not unmet, unmet)


class Depots(Domain):
    name = "depot"
    description = "A robot stows parcels."
    settings = ("small",)
    default_setting = "small"
    instance_type = DepotInstance
    env = Depot
    parcels = 3

    def instance(self, setting, seed):
        xs = np.random.default_rng(seed).permutation(self.parcels)
        return DepotInstance(tuple(round(0.31 + 1.3 * float(x) / self.parcels + 0.01 * seed, 2) for x in xs))

    def make(self, instance, options):
        return self.env(instance)

    def stand_in(self):
        return stow_all


def stow_all(context, rng):
    plan = []
    for name in context.objects:
        if name.startswith("parcel"):
            plan += [Action("take", (name,)), Action("stow", (name, "east"), {"depth": 0.25})]
    return json.dumps({"Reasoning": "stow all", "Full Plan": [str(action) for action in plan]})


def a_depot(**parts):
    """The domain with other parts: those that it has itself replace them, and all others go to its Env."""
    own = {name: part for name, part in parts.items() if hasattr(Depots, name) and name != "__init__"}
    env = type("Depot", (Depot,), {name: part for name, part in parts.items() if name not in own})
    return type("Depots", (Depots,), {"env": env, **own})()
