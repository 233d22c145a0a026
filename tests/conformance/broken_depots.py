"""Depots that lose things, mix them up or remember them, as many do that are written in an afternoon."""

from __future__ import annotations

import random
from dataclasses import replace

import numpy as np
from depot import LOCKERS, Depot, DepotInstance, a_depot
from planted import Planted

from llm3.types import Entity, Goal, MotionProblem, NoMotion, Pose, Transition

TAKE, STOW, CHARGE = Depot.schemas


def stowing_by_name(self, state, action, rng):
    """Looks for the locker first, and only once something is held."""
    if action.name == "stow" and state.held:
        LOCKERS[action.objects[1]]
    return Depot.prepare(self, state, action, rng)


def reaching(self, state, action, rng):
    """Reaches into the locker with an arm that is a little too short."""
    answer = Depot.prepare(self, state, action, rng)
    if action.name == "stow" and isinstance(answer, NoMotion):
        goal = Goal((action.params["depth"],))
        MotionProblem((0.0,), (goal,), 0.0, 0.49, lambda Q: np.ones(len(Q), dtype=bool), 0.01)
    return answer


def taking_more(self, state, action):
    """Takes a parcel while it holds another one."""
    why = Depot.refusal(self, state, action)
    return "" if why == "the hand is not empty" and state.held.object != action.objects[0] else why


def charging(**fields):
    """Charges, and loses something."""

    def apply(self, state, action, motion):
        after = Depot.apply(self, state, action, motion)
        if action.name != "charge":
            return after
        return Transition(replace(after.state, **{name: make(after.state) for name, make in fields.items()}))

    return apply


def swapped(self, state):
    """Tells of each parcel under the name of the next."""
    a, b, *_ = names = self.parcels
    shown = [Entity(name, self.where(state, {a: b, b: a}.get(name, name))) for name in names]
    return *shown, *Depot.describe(self, state)[len(names) :]


def where(write):
    """A description in which places are written by a function of the position."""
    return lambda self, state, name: (
        {"position": write(state.poses[name].position)} if name in state.poses else {"place": "in the hand"}
    )


def rounded(position):
    return tuple(round(c, 1) for c in position[:2])


def half(position):
    return "west" if position[0] < 1 else "east"


def cached(name, key):
    """A method whose answers are kept by a part of what they depend on."""

    def method(self, state, *others):
        cache = self.__dict__.setdefault(f"_{name}", {})
        by = key(state, *others)
        if by not in cache:
            cache[by] = getattr(Depot, name)(self, state, *others)
        return cache[by]

    return method


def unlike_numbers(self, state):
    return *Depot.describe(self, state), Entity("scale", {"weight": float("nan")})


class ForAll(Depot):
    """Its parcels stand in the class."""

    def __init__(self, instance):
        Depot.__init__(self, instance)
        ForAll.instance = instance
        del self.instance


def drawing(name):
    """A method that draws a number that nobody sees."""

    def method(self, *arguments):
        random.random()
        return getattr(Depot, name)(self, *arguments)

    return method


def drawn_instance(self, setting, seed):
    np.random.seed(seed)  # noqa: NPY002  # it is the fault
    return DepotInstance((round(float(np.random.uniform(0.3, 0.7)), 2), 1.5))  # noqa: NPY002  # it is the fault


def drawn_world(self, instance, options):
    random.random()
    return self.env(instance)


class SetInInit(Depot):
    objects = property(Depot.objects.fget)

    def __init__(self, instance):
        Depot.__init__(self, instance)
        self.objects = self.parcels


def never_there(self, state):
    return replace(Depot.goal(self, state), achieved=False, unmet=("a parcel is missing",))


def turned(self, state, action, motion):
    """A parcel stands across in a locker."""
    after = Depot.apply(self, state, action, motion).state
    if action.name != "stow":
        return Transition(after)
    name = action.objects[0]
    pose = Pose(after.poses[name].position, (0.0, 0.0, 0.70711, 0.70711))
    return Transition(replace(after, poses={**after.poses, name: pose}))


OF_FORM: dict[str, Planted] = {
    "regions that raise": Planted(
        a_depot(regions=lambda self, instance: {}["stow"]),
        "nothing is raised",
        "Depots.<lambda> raised KeyError: 'stow' (broken_depots.py:…).",
        "An exception ends a run",
    ),
    "region that is a number": Planted(
        a_depot(regions=lambda self, instance: {("stow", ("parcel_0", "east"), "depth"): 0.2}),
        "regions are parts of the ranges",
        "the region of ('stow', ('parcel_0', 'east'), 'depth') is 0.2, which is no range.",
        "a pair of finite numbers",
    ),
    "region upside down": Planted(
        a_depot(regions=lambda self, instance: {("stow", ("parcel_0", "east"), "depth"): (0.4, 0.2)}),
        "regions are parts of the ranges",
        "the region of ('stow', ('parcel_0', 'east'), 'depth') is (0.4, 0.2), which is no range.",
        "the lower one first",
    ),
    "region elsewhere": Planted(
        a_depot(regions=lambda self, instance: {("stow", ("parcel_0", "east"), "depth"): (0.6, 0.7)}),
        "regions are parts of the ranges",
        "the region of ('stow', ('parcel_0', 'east'), 'depth') is 0.6 to 0.7, and the parameter's range 0 to 0.5.",
        "refused as an invalid action",
    ),
    "no schemas": Planted(
        a_depot(schemas=None),
        "schemas tell what there is to do",
        "schemas must be a tuple of ActionSchema, at least one, not None.",
        "comma",
    ),
    "one schema": Planted(
        a_depot(schemas=CHARGE),
        "schemas tell what there is to do",
        "schemas must be a tuple of ActionSchema, at least one, not ActionSchema(…).",
        "A tuple of one needs a comma",
    ),
    "no objects": Planted(
        a_depot(objects=None),
        "objects have different names",
        "objects must be a tuple of names, not None.",
        "comma",
    ),
    "objects that raise": Planted(
        a_depot(objects=property(lambda self: self.lockers)),
        "nothing is raised",
        "Depot.<lambda> raised AttributeError: 'Depot' object has no attribute 'lockers' (broken_depots.py:…).",
        "An exception ends a run",
    ),
    "objects that are set": Planted(
        type("SetDepots", (type(a_depot()),), {"env": SetInInit})(),
        "nothing is raised",
        "SetDepots.make raised AttributeError: …objects… (…).",
        "What varies by instance is a @property of the Env",
    ),
    "nothing that is a number": Planted(
        a_depot(describe=unlike_numbers),
        "the state is described",
        "weight of scale holds 'nan': nan.",
        "f-string",
    ),
}
OF_SLOTS: dict[str, Planted] = {
    "parcel in the place of a locker": Planted(
        a_depot(prepare=stowing_by_name),
        "nothing is raised",
        "small, seed 0, stow([…, 'parcel_…'], {…}): Depot.stowing_by_name raised KeyError: 'parcel_…' "
        "(broken_depots.py:…).",
        "what the robot cannot do is a Failure",
    ),
    "range that is too wide": Planted(
        a_depot(prepare=reaching),
        "nothing is raised",
        "small, seed 0, stow([…], {'depth': 0.5}): Depot.reaching raised ValueError: joint value 0 of a goal is 0.5, "
        "outside of its limits 0 to 0.49: refuse an action that would need it, or widen `low` and `high` "
        "(broken_depots.py:…).",
        "The sentence says what MotionProblem takes.",
    ),
    "held parcel that is lost": Planted(
        a_depot(refusal=taking_more),
        "no object and no fact gets lost",
        "after take(['parcel_…'], {}) 'parcel_…' is neither somewhere nor held.",
        "the poses of what did not move",
    ),
    "parcel that is lost": Planted(
        a_depot(
            apply=charging(poses=lambda state: dict(list(state.poses.items())[1:])),
            where=lambda self, state, name: {"position": state.poses[name].position},
        ),
        "no object and no fact gets lost",
        "after charge([], {}) 'parcel_…' is neither somewhere nor held.",
        "the whole next state",
    ),
    "fact that is lost": Planted(
        a_depot(apply=charging(facts=lambda state: {"charged": True})),
        "no object and no fact gets lost",
        "after charge([], {}) the fact 'taken' is gone, for which describe or goal asks.",
        "with what changes put in",
    ),
}
OF_WORDS: dict[str, Planted] = {
    "swapped parcels": Planted(
        a_depot(describe=swapped),
        "the description follows the state",
        "… changes where 'parcel_…' is, and what that alone changes in the description is told of something else: "
        "parcel_…: position (…).",
        "under its own name",
    ),
    "places to a tenth of a metre": Planted(
        a_depot(where=where(rounded)),
        "a small move is told",
        "5 moves of 'parcel_…' by 0.02 m each, one after the other, show 1 times in the description.",
        "write centimetres",
    ),
    "parcel that is turned": Planted(
        a_depot(apply=turned),
        "the description follows the state",
        "stow(['parcel_…', '…'], {…}) changes how 'parcel_…' is turned, and the description with that alone changed is "
        "the same.",
        "how each object is turned",
    ),
}
OF_MEMORY: dict[str, Planted] = {
    "refusals by object": Planted(
        a_depot(refusal=cached("refusal", lambda state, action: (action.name, action.objects))),
        "a new world answers like one in use",
        "a new world prepares … differently than one in which actions were carried out: …",
        "a cache that goes by all that the answer depends on",
    ),
    "description by configuration": Planted(
        a_depot(describe=cached("describe", lambda state: state.configuration)),
        "a new world answers like one in use",
        "a new world describes a state of … objects differently than one in which actions were carried out: …",
        "a cache that goes by all that the answer depends on",
    ),
    "parcels in the class": Planted(
        type("ForAllDepots", (type(a_depot()),), {"env": ForAll})(),
        "a next world leaves others alone",
        "small, seed 1: once the next world is made, one of small, seed 0 answers differently: …",
        "a class attribute or a global is the same for all worlds",
        seeds=(0, 1),
    ),
    "worlds without their instance": Planted(
        a_depot(__init__=lambda self, instance: setattr(self, "instance", DepotInstance((0.4, 0.8)))),
        "another instance gives another world",
        "small, seed 0 and small, seed 1 are different instances, and their worlds are alike: task, objects, state and "
        "description.",
        "does not look at its instance",
        seeds=(0, 1),
    ),
    "stand-in that misses the goal": Planted(
        a_depot(goal=never_there),
        "the stand in reaches the goal",
        "the stand-in reaches the goal in none of 1 worlds, and in the first one this is missing: a parcel is missing.",
        "Its plans are wrong",
    ),
}
OF_CHANCE: dict[str, Planted] = {
    name: Planted(
        plugin,
        "chance comes from the generator that is given",
        f"{name} draws from the global generator of random or numpy.",
        "Draw from the rng",
    )
    for name, plugin in (
        ("describe", a_depot(describe=drawing("describe"))),
        ("goal", a_depot(goal=drawing("goal"))),
        ("reset", a_depot(reset=drawing("reset"))),
        ("make", a_depot(make=drawn_world)),
    )
} | {
    "instance": Planted(
        a_depot(instance=drawn_instance),
        "the same seed gives the same instance",
        "instance('small', 0) draws from the global generator of random or numpy.",
        "np.random.default_rng(seed)",
    )
}
FAULTS = OF_FORM | OF_SLOTS | OF_WORDS | OF_MEMORY | OF_CHANCE


def told_by_halves(parcels):
    """A sound depot that tells no number of where parcels are."""
    return a_depot(where=where(half), parcels=parcels)
